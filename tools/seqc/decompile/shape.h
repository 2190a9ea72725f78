#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "decompile/formula.h"
#include "decompile/groups.h"
#include "decompile/layout.h"
#include "semantics/model.h"

namespace nplc::seqc {

/// What holds for the whole table.
struct Surroundings {
    std::vector<std::uint8_t> outputs;  ///< OUT of every step, by number
    std::optional<Action> fault;        ///< what ON ERROR does; `next` is the fault step
};

/// A step as branches and outputs.
struct Shape {
    StepPlan plan;          ///< rules in order of writing, ON ERROR's not among them
    std::size_t terms = 0;  ///< how many of the step's terms, from the first, they make
};

/// One branch of the chain IF .. ELSIF .. ELSE.
struct Link {
    Formula condition;
    const Action* action = nullptr;
};

/// The conditions of rules, each without what those before it have taken.
std::vector<Link> chain_of(const std::vector<Rule>& rules, const BitNames& names);

/// What a step does on ERROR if that is the same in all cases and leads to another step.
const Action* error_exit(const Part& part, const std::vector<Group>& groups, const Surroundings& around);

/// Whether `action` ends with all that `tail` does beside its NEXT.
bool ends_with(const Action& action, const Action& tail);

/// Whether the compiler makes exactly the first `count` terms of these rules.
bool makes(const StepPlan& plan, const Part& part, std::size_t count, const Surroundings& around);

/// The shape that the compiler makes the step's first terms of: of all if there is one, else of so many that
/// those left over can stand behind it as TERMs and still be understood. Nothing if there is none.
std::optional<Shape> find_shape(const Part& part, const std::vector<Group>& groups,
                                const Surroundings& around);

/// What POWER_UP does, if the terms of step 0 are what the compiler makes of one.
struct PowerUp {
    Action action;
    std::size_t values = 0;  ///< how many of its first sends are VAR_MOTOR's values
    Action commands;         ///< the action without them
};
std::optional<PowerUp> find_power_up(const Part& part, const std::vector<Group>& groups,
                                     const Surroundings& around);

}  // namespace nplc::seqc
