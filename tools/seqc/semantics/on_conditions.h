#pragma once

#include <bitset>
#include <cstdint>
#include <optional>
#include <vector>

#include "semantics/scope.h"
#include "semantics/truth.h"
#include "syntax/ast.h"

namespace nplc::seqc {

/// An ON condition with the steps in which it holds, by their numbers.
struct OnCondition {
    const ast::OnCondition* written = nullptr;
    Truth when;
    std::bitset<64> steps;
    bool covers_one = false;  ///< a step beside the one that it leads to
    bool may_act = false;     ///< those before it leave it a case in one of them
};

/// Those of the program, the first one first. `fault`: the step of ON ERROR, which only its name covers.
std::vector<OnCondition> on_conditions(const ast::Program& program, Scope& scope,
                                       std::optional<std::uint8_t> fault);

}  // namespace nplc::seqc
