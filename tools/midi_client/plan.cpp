#include "midi_client/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace nplc::midi_client {
namespace {

constexpr std::int64_t kLongest = 0xFFFF;
constexpr std::int64_t kMostSteps = 0x7FFF;

std::int64_t rounded(std::int64_t dividend, std::int64_t divisor) {
    return (2 * dividend + divisor) / (2 * divisor);
}

/// Writes an axis's segments so that each ends as near as can be to its time from the start.
class AxisWriter {
  public:
    explicit AxisWriter(std::uint8_t address) { axis_.address = address; }

    /// As few segments as possible; the next one compensates for the rounding.
    void stand(std::int64_t until) {
        for (std::int64_t enough = 0; until - now_ > enough; enough = kLongest) {
            const std::int64_t left = until - now_;
            const std::int64_t steps = std::min((left + kLongest - 1) / kLongest, kMostSteps);
            add(true, steps, std::min(rounded(left, steps), kLongest));
        }
    }

    /// False: it were too fast.
    bool turn(std::int64_t steps, std::int64_t until) {
        const std::int64_t sign = steps < 0 ? -1 : 1;
        for (std::int64_t left = std::abs(steps); left > 0;) {
            // As few segments as possible, of equal length.
            const std::int64_t parts = (left + kMostSteps - 1) / kMostSteps;
            const std::int64_t now = left / parts;
            const std::int64_t period = rounded((until - now_), left);
            if (period < 1) return false;
            add(false, sign * now, std::min(period, kLongest));
            left -= now;
        }
        return true;
    }

    std::int64_t now() const { return now_; }
    AxisPlan take() { return std::move(axis_); }

  private:
    void add(bool pause, std::int64_t steps, std::int64_t period) {
        const Segment segment{pause, static_cast<std::int32_t>(steps), static_cast<std::int32_t>(period)};
        axis_.segments.push_back(segment);
        now_ += segment.ticks();
    }

    AxisPlan axis_;
    std::int64_t now_ = 0;
};

bool is_whole(const std::vector<std::uint8_t>& addresses, const std::vector<Waypoint>& path) {
    return std::all_of(path.begin(), path.end(),
                       [&](const Waypoint& one) { return one.positions.size() == addresses.size(); });
}

/// Steps of this axis in the interval that ends at waypoint `i`; 0 beyond the ends.
std::int64_t steps_in(const std::vector<Waypoint>& path, std::size_t i, std::size_t axis) {
    if (i == 0 || i >= path.size()) return 0;
    return path[i].positions[axis] - path[i - 1].positions[axis];
}

/// Slower than a segment can be: it stands on the side where it is slower anyhow.
bool creep(AxisWriter& writer, const std::vector<Waypoint>& path, std::size_t i, std::size_t axis) {
    const std::int64_t steps = steps_in(path, i, axis);
    const std::int64_t turning = std::abs(steps) * kLongest;
    const bool faster_later = std::abs(steps_in(path, i + 1, axis)) > std::abs(steps_in(path, i - 1, axis));
    if (faster_later) writer.stand(path[i].ticks - turning);
    if (!writer.turn(steps, faster_later ? path[i].ticks : writer.now() + turning)) return false;
    if (!faster_later) writer.stand(path[i].ticks);
    return true;
}

bool write_interval(AxisWriter& writer, const std::vector<Waypoint>& path, std::size_t i, std::size_t axis) {
    const std::int64_t steps = steps_in(path, i, axis);
    const std::int64_t time = path[i].ticks - writer.now();
    if (steps == 0) {
        writer.stand(path[i].ticks);
        return true;
    }
    return std::abs(steps) * kLongest < time ? creep(writer, path, i, axis)
                                             : writer.turn(steps, path[i].ticks);
}

}  // namespace

std::int64_t AxisPlan::ticks() const {
    std::int64_t sum = 0;
    for (const Segment& one : segments) sum += one.ticks();
    return sum;
}

std::int64_t AxisPlan::displacement() const {
    std::int64_t sum = 0;
    for (const Segment& one : segments) sum += one.pause ? 0 : one.steps;
    return sum;
}

std::int64_t Plan::ticks() const {
    std::int64_t longest = 0;
    for (const AxisPlan& axis : axes) longest = std::max(longest, axis.ticks());
    return longest;
}

Planned plan_path(const std::vector<std::uint8_t>& addresses, const std::vector<Waypoint>& path) {
    if (addresses.empty() || path.size() < 2 || path.front().ticks != 0 || !is_whole(addresses, path))
        return {{}, "a path needs at least two points, the first at time 0, with a position for each axis"};
    Plan plan;
    for (std::size_t axis = 0; axis < addresses.size(); ++axis) {
        AxisWriter writer(addresses[axis]);
        for (std::size_t i = 1; i < path.size(); ++i) {
            if (path[i].ticks <= path[i - 1].ticks)
                return {{}, fmt::format("point {}: its time is not later than the one before", i + 1)};
            if (!write_interval(writer, path, i, axis))
                return {{},
                        fmt::format("point {}: axis {} would have to be faster than a segment can say "
                                    "(8000000 increments a second)",
                                    i + 1, addresses[axis])};
        }
        plan.axes.push_back(writer.take());
    }
    return {std::move(plan), {}};
}

std::uint32_t segment_data(const Segment& segment) {
    return static_cast<std::uint32_t>(segment.steps & 0xFFFF) << 16 |
           static_cast<std::uint32_t>(segment.period & 0xFFFF);
}

}  // namespace nplc::midi_client
