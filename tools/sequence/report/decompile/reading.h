#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "compiler/model.h"
#include "report/decompile/groups.h"
#include "report/decompile/shape.h"

namespace nplc::seqc {

/// Interpretations of a term that names its own step as the next one.
enum class Staying : std::uint8_t {
    undoes,   ///< it only cancels a transition of an earlier term
    is_said,  ///< NEXT to the own step was written where nothing else happens
    mixed,    ///< as `undoes` where nothing else happens, as written where something does
};

/// The effects of a step's groups, case by case, as mutually exclusive rules.
class Reading {
  public:
    Reading(std::uint8_t step, const std::vector<Group>& groups, std::size_t count,
            const Surroundings& around)
        : step_(step), groups_(groups), count_(count), around_(around) {}

    /// Empty if branches cannot express it. `on_error`: ON ERROR handles ERROR.
    std::optional<StepPlan> run(Staying staying, bool on_error);

  private:
    bool decide();
    bool add_case(std::size_t number, Staying staying);
    bool add_rule(const Action& action, std::size_t number);
    bool add_conditional(StepPlan& plan) const;
    std::uint8_t own_outputs() const { return around_.outputs[step_]; }

    std::uint8_t step_;
    const std::vector<Group>& groups_;
    std::size_t count_;
    const Surroundings& around_;
    std::array<int, kCases> decisive_{};  ///< the last group with an effect; -1: none
    std::array<int, kCases>
        resting_{};  ///< outputs while the step stays active; -1: not written, -2: unchanged
    std::vector<Rule> rules_;
    bool shows_outputs_ = false;
};

/// Number of groups, from the first, that can be expressed without TERMs: they do not act together in other
/// ways.
std::size_t compatible_groups(const std::vector<Group>& groups);

}  // namespace nplc::seqc
