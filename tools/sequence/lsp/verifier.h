#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/verify.h"
#include "seqc/seqc.h"

namespace nplc::seqc::lsp {

/// A program to be verified, with its own properties.
struct VerifyJob {
    std::string uri;           ///< of the program, or of a property file whose text is inserted in `source`
    std::int64_t version = 0;  ///< of that document
    Sources sources;
};

struct Finding {
    Span span;
    std::string code;  ///< V004; empty for a property
    std::string name;
    std::string message;
    enum class Level : std::uint8_t { error, warning, information, hint } level = Level::hint;
    std::vector<Note> related;  ///< the scans of a counter-example, at their steps
    std::string scenario;       ///< the counter-example as a scenario; empty if there is none
};

struct VerifyOutcome {
    std::string uri;
    std::int64_t version = 0;
    std::string source;  ///< the verified text
    std::size_t states = 0;
    bool complete = false;
    std::vector<Finding> findings;
};

/// Long-running: not for the thread that answers the editor.
VerifyOutcome verify_program(const VerifyJob& job);

}  // namespace nplc::seqc::lsp
