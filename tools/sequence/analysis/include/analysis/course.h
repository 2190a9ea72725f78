#pragma once

#include <cstdint>
#include <vector>

#include "sequencer/state.h"

namespace nplc::verify {

/// A scan of a course, with times for its execution.
struct PlayedScan {
    std::uint8_t image = 0;
    std::uint32_t dt_ms = 0;  ///< to the next scan
    std::uint8_t step = 0;    ///< in which it began
    bool repeats = false;     ///< a repetition of the one before, while time passes
    bool begins = false;      ///< the time of the property that the course breaks begins with it
    sequencer::State after;   ///< before any time is taken off the timer
    std::vector<sequencer::MotorOrder> orders;
};

using Course = std::vector<PlayedScan>;

/// The value of a preset range in a course.
struct ChosenPreset {
    std::uint16_t preset = 0;  ///< the range's `value`
    std::uint16_t chosen = 0;
};

/// A course, and the presets with which it can be executed.
struct Played {
    Course course;
    std::vector<ChosenPreset> presets;  ///< those of ranges that it meets
};

}  // namespace nplc::verify
