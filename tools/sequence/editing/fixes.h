#pragma once

#include <string>
#include <vector>

#include "editing/program.h"

namespace nplc::seqc::analysis {

struct Fix {
    std::string title;
    std::vector<TextEdit> edits;
    bool preferred = false;
};

/// Text changes for a diagnostic's advice.
std::vector<Fix> fixes_for(const Program& program, const Diagnostic& diagnostic);

/// ALLOW CODE BECAUSE '...'; in the step around a finding of `seqc verify`.
std::vector<Fix> allow_in(const Program& program, Span step_name, std::string_view code);

}  // namespace nplc::seqc::analysis
