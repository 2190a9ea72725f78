#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The properties that are checked in every table without being asked for.
namespace nplc::verify {

enum class Severity : std::uint8_t { fault, advice };

struct Check {
    std::string_view code;  ///< V004
    Severity severity;
    std::string_view name;  ///< of its result: Acknowledged
    std::string_view text;  ///< the statement that holds if nothing is found
};

/// All of them, sorted by code.
std::span<const Check> checks();

/// A check that the program's author switched off in a step.
struct Allowance {
    std::string code;
    std::uint8_t step = 0;
    std::string reason;
};

}  // namespace nplc::verify
