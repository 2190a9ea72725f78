#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "analysis/course.h"
#include "explorer.h"

/// One value for each range of presets, so that a course found with ranges can be executed.
namespace nplc::verify {

/// Values that may make the course: counts as the course has them, times at the ends of their ranges. None if
/// it has different counts of one range; one empty choice if it meets no range.
std::vector<std::vector<ChosenPreset>> choices_for(const Machine& machine, std::span<const CourseScan> scans);

/// The value of `preset` in `chosen`; itself if it is not there.
std::uint16_t chosen_value(std::span<const ChosenPreset> chosen, std::uint16_t preset);

/// The table's bytes, end term and all, with the chosen values.
std::vector<std::uint8_t> bytes_with(const sequencer::Table& table, std::span<const ChosenPreset> chosen);

}  // namespace nplc::verify
