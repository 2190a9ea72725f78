#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "registers/midi.h"

/// Paths of several axes as segments (16h) and pauses (1Eh), 000 §VI, 003 §VII: each a number of steps at one
/// period, in ticks of 0.125 us. Whole numbers only.
namespace nplc::midi_client {

/// One entry of a module's FIFO.
struct Segment {
    bool pause = false;  ///< nothing turns; it takes the time of `steps` at `period`
    std::int32_t steps = 0;
    std::int32_t period = 1;

    std::int64_t ticks() const { return std::int64_t{steps < 0 ? -steps : steps} * period; }
    bool operator==(const Segment&) const = default;
};

struct AxisPlan {
    std::uint8_t address = 0;
    std::vector<Segment> segments{};
    std::int64_t ticks() const;         ///< of all of them
    std::int64_t displacement() const;  ///< from the first to the last
};

struct Plan {
    std::vector<AxisPlan> axes{};
    std::int64_t ticks() const;  ///< of the axis that takes longest
};

/// Where the axes are to be at a time; between two the way is straight, at constant speed.
struct Waypoint {
    std::int64_t ticks = 0;                 ///< from the start; the first has 0
    std::vector<std::int64_t> positions{};  ///< increments, one an axis
    bool operator==(const Waypoint&) const = default;
};

struct Planned {
    Plan plan{};
    std::string error{};  ///< a sentence; empty: all is well
};

/// An axis is behind or ahead of a waypoint's time by at most half a tick a step of the segment before it,
/// and nothing of that adds up: each segment ends as near as can be to its waypoint's time from the start.
/// Where an axis has to creep slower than period 65535 says, it stands for a part of the time and makes its
/// steps, 12 in 100 ms at the most, in the rest, next to where it is faster.
Planned plan_path(const std::vector<std::uint8_t>& addresses, const std::vector<Waypoint>& path);

/// What goes into the command's parameters.
std::uint32_t segment_data(const Segment& segment);

/// A circle of two axes that begins and ends at its rightmost point, at exactly the same increments.
struct Circle {
    std::int64_t radius = 0;                  ///< increments, of both axes
    std::int64_t centre_x = 0, centre_y = 0;  ///< increments
    double speed = 0;                         ///< along the circle, increments a second
    double acceleration = 0;                  ///< at its start and end, increments a second^2; 0: none
    unsigned turns = 1;
    bool clockwise = false;     ///< x to the right, y up
    double segment_time = 0.1;  ///< seconds at full speed, about; the circle gets at least 24 segments a turn
};

/// Corners that lie on the circle, rounded to whole increments. Empty if radius or speed are none.
std::vector<Waypoint> circle_path(const Circle& circle);

/// How far a straight way between two corners strays from the circle, rounding included, increments: what an
/// exact drive would show.
double circle_deviation(const Circle& circle, const std::vector<Waypoint>& path);

}  // namespace nplc::midi_client
