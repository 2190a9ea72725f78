#pragma once

#include <string>

namespace nplc::bench {

inline constexpr unsigned kFullSteps = 61;  // all that can be named
inline constexpr unsigned kFullTerms = 992;

/// A program of kFullSteps varied steps that compiles to kFullTerms terms, the end term left out.
std::string full_program();

/// Each unit is four steps and a call with groups, time limits, edges, outputs that are set or blink: ten
/// steps of the table. `rests` are steps with a time limit, one of the table each.
std::string machine_program(unsigned units, unsigned rests);

inline constexpr unsigned kMachineUnits = 5, kMachineRests = 9;  // kFullSteps of the table

/// Conditions with as many products as a table holds, over all that a term can test.
std::string worst_program();

}  // namespace nplc::bench
