#pragma once

#include <string>
#include <vector>

namespace nplc::seqc::cli {

struct MotorLines {
    std::vector<std::string> lines{};
    std::string error{};  ///< empty: no error
};

/// A scenario's initial settings of its motor: plant, stored registers, stops, load, sensors. For a plant
/// file, as written by `macreg fit`, the line that loads it.
MotorLines motor_lines_of(const std::string& file);

}  // namespace nplc::seqc::cli
