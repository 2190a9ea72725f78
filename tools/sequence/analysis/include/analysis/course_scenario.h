#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/verify.h"

/// A course as a scenario for `nanoplc-sim run`.
namespace nplc::verify {

struct ScenarioOptions {
    std::vector<std::string> plant{};  ///< lines about the motor that come first
    /// Inputs that change in the very scan that leaves a step change after it, else before. A course does not
    /// determine which; with a real motor one of the two may lead to other steps.
    bool changes_late = false;
    /// An input that changes within the debounce time after a step was entered changes so long after an event
    /// before that, `steps_back` step changes earlier, so that a step of a few milliseconds still sees it; 0:
    /// after the step was entered.
    std::uint32_t ahead_ms = 0;
    std::uint32_t steps_back = 1;
};

/// Inputs follow the steps of the course, so that a motor may take its time; the run ends where the course
/// does, with a `log` of what breaks there, or long after that could have been. The result must have a
/// course.
std::string scenario_of(const Result& result, const Names& names, const ScenarioOptions& options = {});

}  // namespace nplc::verify
