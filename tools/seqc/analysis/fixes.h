#pragma once

#include <string>
#include <vector>

#include "analysis/program.h"

namespace nplc::seqc::analysis {

struct Fix {
    std::string title;
    std::vector<TextEdit> edits;
    bool preferred = false;
};

/// What a diagnostic advises, as changes of the text.
std::vector<Fix> fixes_for(const Program& program, const Diagnostic& diagnostic);

/// Names in properties that are no signal, no step and no word of properties.
std::vector<Span> unknown_in_properties(const Program& program);
/// Names of signals and steps in the place of those that the program does not have, for the properties that a
/// range touches. `seqc verify` reads them, not the compiler: it has no diagnostic for them.
std::vector<Fix> fixes_for_properties(const Program& program, Span range);

/// ALLOW CODE BECAUSE '...'; in the step around a finding of `seqc verify`.
std::vector<Fix> allow_in(const Program& program, Span step_name, std::string_view code);

}  // namespace nplc::seqc::analysis
