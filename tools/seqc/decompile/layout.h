#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "registers/mac.h"
#include "sequencer/term.h"

namespace nplc::seqc {

using Terms = std::vector<sequencer::TermBytes>;

/// The terms of a step that stand together; none if the step is only named.
struct Part {
    std::uint8_t number = 0;
    Terms terms;
};

/// A table as the parts of a program. The compiler puts out steps in order of declaration, then all else.
struct Layout {
    std::vector<Part> steps;  ///< every number 0..61 that the table names, and 0 if there is any; each once
    Terms outside;            ///< from the first term on that cannot stand inside its step
    sequencer::TermBytes end{};
};

/// `table`: whole terms, the last one with STATE 63.
Layout layout_of(std::span<const std::uint8_t> table);

/// The motor whose registers fit the most of the table's writes; MAC140 if none fits better.
registers::Model fitting_motor(const Layout& layout);

}  // namespace nplc::seqc
