#pragma once

#include <array>
#include <string>

/// Steps x terms of the measured tables. The generator makes one table and one switch of each.
namespace nplc::bench {

struct Size {
    int steps;
    int terms;  ///< of each step
};

inline constexpr std::array<Size, 4> kSizes{{{8, 1}, {62, 1}, {62, 4}, {62, 16}}};

inline std::string name_of(Size size) {
    return std::to_string(size.steps) + "x" + std::to_string(size.terms);
}

}  // namespace nplc::bench
