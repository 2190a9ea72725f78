#pragma once

#include <cstdint>
#include <string>

namespace nplc::sim {

/// Values of command line options; std::invalid_argument, with the option and what to write, for others.
std::int64_t whole_value(const std::string& option, const std::string& text, std::int64_t min,
                         std::int64_t max);
/// Times real time, 0.01 to 100.
double speed_value(const std::string& text);
/// What stands before and behind the colon of MODEL:ADDRESS; `example` is one, for the message.
struct UnitText {
    std::string model;
    std::string address;
};
UnitText unit_value(const std::string& text, const std::string& example);

}  // namespace nplc::sim
