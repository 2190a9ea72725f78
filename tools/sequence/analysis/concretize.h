#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "analysis/course.h"
#include "conflict.h"
#include "explorer.h"

namespace nplc::verify {

/// The minimum time between two scans.
struct Overdue {
    std::size_t from = 0;  ///< index of the scan
    std::size_t to = 0;    ///< the number of scans is the one that would follow the last
    std::uint32_t more_than_ms = 0;
};

struct Realization {
    const sequencer::Table& table;
    Assume assume = Assume::any;
    std::array<std::uint32_t, 6> stable_ms{};  ///< how long each input keeps its level
    std::uint32_t move_ms = 0;  ///< within which a move to a place ends; 0 for whenever it likes
    std::span<const ChosenPreset> presets{};  ///< values of the explorer's ranges; the table has them
};

/// A course that was executed, or the reason why it is impossible.
struct Attempt {
    std::optional<Course> course{};
    Conflict conflict{};
};

/// Chooses images and times for a course of the explorer that satisfy timer, delays and debouncing, and
/// executes it on the engine.
Attempt concretize(const Realization& how, std::span<const CourseScan> scans,
                   const std::optional<Overdue>& overdue);

}  // namespace nplc::verify
