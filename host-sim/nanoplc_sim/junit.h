#pragma once

#include <string>
#include <vector>

#include "sim/scenario_runner.h"

namespace nplc::sim {

/// A scenario's expectations as JUnit XML for build servers: one test case each, times in virtual seconds.
/// Invalid UTF-8 and unprintable characters become '?'.
std::string junit_of(const std::vector<ExpectationResult>& outcomes, const std::string& scenario,
                     const std::string& program, Time end);

}  // namespace nplc::sim
