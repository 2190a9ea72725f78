#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "registers/mac.h"
#include "sequencer/term.h"

namespace nplc::seqc {

using Terms = std::vector<sequencer::TermBytes>;

/// The adjacent terms of a step; empty if the step is only referenced.
struct Part {
    std::uint8_t number = 0;
    Terms terms;
};

/// A table as parts of a program. The compiler emits steps in order of declaration, then everything else.
struct Layout {
    std::vector<Part> steps;  ///< every number 0..61 used in the table, and 0 if there is any; each once
    Terms outside;            ///< from the first term that cannot be inside its step
    sequencer::TermBytes end{};
};

/// `table`: whole terms, the last one with STATE 63.
Layout layout_of(std::span<const std::uint8_t> table);

/// The motor whose registers fit most of the table's writes; MAC140 if none fits better.
registers::Model fitting_motor(const Layout& layout);

}  // namespace nplc::seqc
