#pragma once

#include <cstdint>
#include <vector>

#include "compiler/model.h"
#include "registers/mac.h"
#include "report/decompile/layout.h"

namespace nplc::seqc {

/// Adjacent terms with one condition that are exactly the compiler's translation of one action.
struct Group {
    std::size_t first = 0;  ///< index in the step's terms
    std::size_t count = 0;
    Truth when;
    Action action;
    std::uint8_t outputs = 0;
    bool writes_outputs = false;  ///< has a term in FastMAC format
    bool sound = false;           ///< false: a term that is not the translation of an action

    bool cannot_be_undone() const { return !action.sends.empty() || action.presets(); }
    bool leaves(std::uint8_t step) const { return action.next && *action.next != step; }
};

std::vector<Group> groups_of(const Terms& terms, registers::Model model);

}  // namespace nplc::seqc
