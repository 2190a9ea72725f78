#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "decompile/groups.h"
#include "decompile/shape.h"
#include "semantics/model.h"

namespace nplc::seqc {

/// Ways to take a term that names its own step as the next one.
enum class Staying : std::uint8_t {
    undoes,   ///< it only takes a switch of an earlier term back
    is_said,  ///< NEXT to the own step was written where nothing else happens
    mixed,    ///< as `undoes` where nothing else happens, written where something does
};

/// What a step's groups do, case by case, as rules that never hold together.
class Reading {
  public:
    Reading(std::uint8_t step, const std::vector<Group>& groups, std::size_t count,
            const Surroundings& around)
        : step_(step), groups_(groups), count_(count), around_(around) {}

    /// Nothing if no branches can say it. `on_error`: ON ERROR deals with ERROR.
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
    std::array<int, kCases> decisive_{};  ///< the last group that writes something; -1: none
    std::array<int, kCases> resting_{};   ///< outputs while the step stays; -1: not written, -2: left
    std::vector<Rule> rules_;
    bool shows_outputs_ = false;
};

/// How many groups, from the first, a program can say without TERMs: none of them act together in other ways.
std::size_t compatible_groups(const std::vector<Group>& groups);

}  // namespace nplc::seqc
