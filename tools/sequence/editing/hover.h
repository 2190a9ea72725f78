#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "editing/program.h"

namespace nplc::seqc::analysis {

struct Hover {
    Span span;
    std::string markdown;
};

/// A register with unit, range, note and the raw value of its constant; a step with its terms, bytes and
/// outgoing transitions; a signal, a command, a word of the language.
std::optional<Hover> hover_at(const Program& program, std::uint32_t offset);

struct Hint {
    std::uint32_t offset = 0;
    std::string text;
    std::string tooltip;
};
/// Inlay hints: raw values of constants, terms of branches and steps, the number of used steps.
std::vector<Hint> hints_in(const Program& program, Span range);

}  // namespace nplc::seqc::analysis
