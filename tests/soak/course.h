#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/text.h"

namespace nplc::soak {

using sim::Time;

/// Something that happens to the machine.
enum class Kind : std::uint8_t {
    input,  ///< value: index, and 8 for the level 1
    cut,    ///< the motor's line; restored by `restore`
    restore,
    spoil,  ///< value: which of the kinds of a bad line
    clean,
    motor_off,
    motor_on,
    motor_error,
    load,  ///< value: torque on the shaft
    stop,
    run,
    power_cut,  ///< of the gateway; an operation of its storage under way is torn
    read,       ///< of a register of the motor over the user's port; value: its number
    look,       ///< a block of the gateway's own; value: its first number
    refused,    ///< a write to the motor, refused while the sequence runs
    noise,      ///< on the user's port; value: its seed
    force,      ///< of the outputs; value: mask and levels
    upload,     ///< value: which of the tables; then it is activated and run
};

struct Disturbance {
    Time at{0};
    Kind kind = Kind::input;
    unsigned value = 0;
    bool operator==(const Disturbance&) const = default;
};

/// In ascending order of time.
using Course = std::vector<Disturbance>;

inline constexpr std::uint8_t kInputOn = 8;
inline constexpr Time kFirst = std::chrono::seconds{2};

/// An operator, a person with a program, and a bad day: the same seed gives the same course, and a longer one
/// goes on where a shorter one ends. From kFirst on.
Course random_course(std::uint64_t seed, Time length);

/// As a scenario for `nanoplc-sim run tests/soak/soak.seq --scenario`. What the language has no words for
/// stands there as `log`.
std::string scenario_of(const Course& course, std::uint64_t seed, Time end, const std::string& remark);
/// False: scenario_of() has a `log` for it.
bool has_words(Kind kind);

/// Shares of the line's faults, of a `spoil`.
struct BadLine {
    double drop = 0;
    double damage = 0;
    double framing = 0;
    double delay = 0;
    Time longest_delay{0};
};
BadLine bad_line(unsigned value);

}  // namespace nplc::soak
