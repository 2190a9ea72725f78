#pragma once

#include <string>
#include <vector>

#include "sim/scenario_runner.h"

namespace nplc::sim {

/// A scenario's expectations as JUnit's XML, which build servers show: one test case each, times in virtual
/// seconds. What is no UTF-8 or cannot be printed becomes '?'.
std::string junit_of(const std::vector<ExpectationResult>& outcomes, const std::string& scenario,
                     const std::string& program, Time end);

}  // namespace nplc::sim
