#pragma once

#include <bitset>
#include <cstdint>
#include <optional>
#include <vector>

#include "compiler/scope.h"
#include "compiler/truth.h"
#include "language/ast.h"

namespace nplc::seqc {

/// An ON condition with the numbers of the steps it applies to.
struct OnCondition {
    const ast::OnCondition* written = nullptr;
    Truth when;
    std::bitset<64> steps;
    bool covers_one = false;  ///< a step other than its target
    bool may_act = false;     ///< earlier conditions leave it a case in one of them
};

/// The program's ON conditions in order. `fault`: the step of ON ERROR, which is covered only by name.
std::vector<OnCondition> on_conditions(const ast::Program& program, Scope& scope,
                                       std::optional<std::uint8_t> fault);

/// Of a step or group that IN does not name.
void warn_of_idle_except(const ast::Name& name, Scope& scope);

}  // namespace nplc::seqc
