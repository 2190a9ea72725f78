#pragma once

#include <string>
#include <vector>

#include "editing/program.h"

namespace nplc::seqc::analysis {

struct Proposal {
    enum class Kind : std::uint8_t {
        keyword,
        step,
        group,
        signal,
        register_name,
        command,
        unit,
        value,
        motor,
        snippet
    };
    Kind kind = Kind::keyword;
    std::string label;
    std::string insert;  ///< with $1 and $0 as cursor positions, if `is_snippet`
    bool is_snippet = false;
    std::string detail;         ///< one line
    std::string documentation;  ///< Markdown; long ones are computed by document_proposal()
};

struct Proposals {
    Span replaced;  ///< the word that is being written
    std::vector<Proposal> list;
};

/// The proposals for a place, taken from the alternatives that the parser tries there.
Proposals complete(const Program& program, std::uint32_t offset);

/// Markdown about a word of the language, from the reference; empty if there is none.
std::string documentation_of(std::string_view word);

/// Signature help: the call of a command, or the values of a register.
struct Signature {
    std::string label;
    std::string documentation;
    std::vector<std::string> parameters;  ///< substrings of the label
    std::size_t active = 0;
};
std::vector<Signature> signatures_at(const Program& program, std::uint32_t offset);

}  // namespace nplc::seqc::analysis
