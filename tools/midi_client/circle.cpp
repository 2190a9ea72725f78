#include <algorithm>
#include <cmath>
#include <numbers>

#include "midi_client/plan.h"
#include "registers/midi_scale.h"

namespace nplc::midi_client {
namespace {

constexpr double kLeastCorners = 24;
constexpr double kTicks = registers::midi::kTicksPerSecond;

/// The time at which a point so far along the path is reached, in seconds: constant acceleration and
/// deceleration.
class Timing {
  public:
    Timing(double length, double speed, double acceleration) : length_(length), acceleration_(acceleration) {
        top_ = acceleration > 0 ? std::min(speed, std::sqrt(acceleration * length)) : speed;
        ramp_ = acceleration > 0 ? top_ * top_ / (2 * acceleration) : 0;
    }
    double at(double way) const {
        if (way > length_ / 2) return total() - half(length_ - way);
        return half(way);
    }
    double total() const { return 2 * half(length_ / 2); }

  private:
    double half(double way) const {
        if (way < ramp_) return std::sqrt(2 * way / acceleration_);
        return (ramp_ > 0 ? top_ / acceleration_ : 0) + (way - ramp_) / top_;
    }

    double length_;
    double acceleration_;
    double top_ = 0;
    double ramp_ = 0;
};

std::int64_t whole(double value) {
    return std::llround(value);
}

}  // namespace

std::vector<Waypoint> circle_path(const Circle& circle) {
    if (circle.radius <= 0 || circle.speed <= 0 || circle.turns == 0 || circle.segment_time <= 0) return {};
    const auto radius = static_cast<double>(circle.radius);
    const double once_round = 2 * std::numbers::pi * radius;
    const double corners =
        std::max(kLeastCorners, std::round(once_round / (circle.speed * circle.segment_time)));
    const auto per_turn = static_cast<std::int64_t>(corners);
    const Timing timing(once_round * circle.turns, circle.speed, circle.acceleration);
    std::vector<Waypoint> path;
    for (std::int64_t i = 0; i <= per_turn * circle.turns; ++i) {
        // The last corner of a turn is the first one, exactly.
        const double part = static_cast<double>(i % per_turn) / corners;
        const double angle = (circle.clockwise ? -2 : 2) * std::numbers::pi * part;
        const double seconds = timing.at(once_round * static_cast<double>(i) / corners);
        path.push_back({.ticks = whole(seconds * kTicks),
                        .positions = {circle.centre_x + whole(radius * std::cos(angle)),
                                      circle.centre_y + whole(radius * std::sin(angle))}});
    }
    return path;
}

double circle_deviation(const Circle& circle, const std::vector<Waypoint>& path) {
    double worst = 0;
    const auto look = [&](double x, double y) {
        const double distance =
            std::hypot(x - static_cast<double>(circle.centre_x), y - static_cast<double>(circle.centre_y));
        worst = std::max(worst, std::abs(distance - static_cast<double>(circle.radius)));
    };
    for (std::size_t i = 0; i < path.size(); ++i) {
        const auto x = static_cast<double>(path[i].positions[0]);
        const auto y = static_cast<double>(path[i].positions[1]);
        look(x, y);
        if (i + 1 == path.size()) break;
        look((x + static_cast<double>(path[i + 1].positions[0])) / 2,
             (y + static_cast<double>(path[i + 1].positions[1])) / 2);
    }
    return worst;
}

}  // namespace nplc::midi_client
