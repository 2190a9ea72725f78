#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What is looked for in every table without a word from the user.
namespace nplc::verify {

enum class Severity : std::uint8_t { fault, advice };

struct Check {
    std::string_view code;  ///< V004
    Severity severity;
    std::string_view name;  ///< of its result: Acknowledged
    std::string_view text;  ///< what holds if nothing is found
};

/// All of them, sorted by code.
std::span<const Check> checks();

/// A check switched off in a step, by who wrote the program.
struct Allowance {
    std::string code;
    std::uint8_t step = 0;
    std::string reason;
};

}  // namespace nplc::verify
