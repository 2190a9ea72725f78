#pragma once

#include <string>

namespace nplc::bench {

inline constexpr unsigned kFullSteps = 61;  // all that can be named
inline constexpr unsigned kFullTerms = 992;

/// A program of kFullSteps varied steps that compiles to kFullTerms terms, the end term left out.
std::string full_program();

/// Conditions with as many products as a table holds, over all that a term can test.
std::string worst_program();

}  // namespace nplc::bench
