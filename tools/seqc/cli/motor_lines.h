#pragma once

#include <string>
#include <vector>

namespace nplc::seqc::cli {

struct MotorLines {
    std::vector<std::string> lines{};
    std::string error{};  ///< empty: there is none
};

/// What a scenario says of its motor at the beginning: plant, stored registers, stops, load, sensors. Of a
/// plant file, as `macreg fit` writes it, the line that takes it.
MotorLines motor_lines_of(const std::string& file);

}  // namespace nplc::seqc::cli
