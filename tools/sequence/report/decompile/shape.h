#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "compiler/model.h"
#include "report/decompile/formula.h"
#include "report/decompile/groups.h"
#include "report/decompile/layout.h"

namespace nplc::seqc {

/// Properties of the whole table.
struct Surroundings {
    std::vector<std::uint8_t> outputs;  ///< OUT of every step, by number
    std::optional<Action> fault;        ///< the action of ON ERROR; `next` is the fault step
};

/// A step in the form of branches and outputs.
struct Shape {
    StepPlan plan;          ///< rules in order of writing, without ON ERROR's
    std::size_t terms = 0;  ///< number of the step's terms, from the first, that they generate
};

/// One branch of the chain IF .. ELSIF .. ELSE.
struct Link {
    Formula condition;
    const Action* action = nullptr;
};

/// The conditions of rules, each without the cases of the previous ones.
std::vector<Link> chain_of(const std::vector<Rule>& rules, const BitNames& names);

/// The step's action on ERROR if it is the same in all cases and leads to another step.
const Action* error_exit(const Part& part, const std::vector<Group>& groups, const Surroundings& around);

/// Whether `action` ends with all effects of `tail` except its NEXT.
bool ends_with(const Action& action, const Action& tail);

/// Whether the compiler generates exactly the first `count` terms from these rules.
bool makes(const StepPlan& plan, const Part& part, std::size_t count, const Surroundings& around);

/// The shape from which the compiler generates the step's first terms: all terms if possible, else as many as
/// leave the remaining TERMs understandable behind it. Empty if there is none.
std::optional<Shape> find_shape(const Part& part, const std::vector<Group>& groups,
                                const Surroundings& around);

/// The action of POWER_UP, if the terms of step 0 are the compiler's translation of one.
struct PowerUp {
    Action action;
    std::size_t values = 0;  ///< number of its first sends that are VAR_MOTOR's values
    Action commands;         ///< the action without these sends
};
std::optional<PowerUp> find_power_up(const Part& part, const std::vector<Group>& groups,
                                     const Surroundings& around);

}  // namespace nplc::seqc
