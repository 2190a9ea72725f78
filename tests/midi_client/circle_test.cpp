// The worked example: two modules draw a circle, on one serial line and on one CAN bus.
#include <gtest/gtest.h>

#include <cmath>

#include "bus_can.h"
#include "midi_client/can_link.h"
#include "midi_client/player.h"
#include "midi_client/v24_link.h"
#include "rack_wire.h"

namespace nplc::midi_client {
namespace {

constexpr double kSecond = 8e6;

const Circle kCircle{
    .radius = 10'000, .centre_x = -10'000, .speed = 20'000, .acceleration = 40'000, .segment_time = 0.05};

/// How far the drawn line strayed from the circle, and how much of it was seen.
class Pen {
  public:
    void draw(std::int32_t x, std::int32_t y) {
        const double distance =
            std::hypot(x - static_cast<double>(kCircle.centre_x), y - static_cast<double>(kCircle.centre_y));
        worst_ = std::max(worst_, std::abs(distance - static_cast<double>(kCircle.radius)));
        left_ = std::min(left_, x);
        top_ = std::max(top_, y);
        bottom_ = std::min(bottom_, y);
    }
    void expect_circle(double bound) const {
        EXPECT_LE(worst_, bound);
        EXPECT_NEAR(left_, -20'000, bound);
        EXPECT_NEAR(top_, 10'000, bound);
        EXPECT_NEAR(bottom_, -10'000, bound);
        testing::Test::RecordProperty("deviation", std::to_string(worst_));
        std::printf("off the circle by %.1f increments at the most, bound %.1f\n", worst_, bound);
    }

  private:
    double worst_ = 0;
    std::int32_t left_ = 0, top_ = 0, bottom_ = 0;
};

/// What may be seen: the chords' own deviation; the axes apart by a tick for each step of a segment at full
/// speed; whole increments, of both axes (sqrt 2); and of an axis that stands for a part of a segment, near
/// an extreme point, the steps that it makes in the rest of it.
double bound_for(const std::vector<Waypoint>& path) {
    double slow_steps = 0;
    double fast_steps = 0;
    for (std::size_t i = 1; i < path.size(); ++i) {
        const double ticks = static_cast<double>(path[i].ticks - path[i - 1].ticks);
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const double steps =
                std::abs(static_cast<double>(path[i].positions[axis] - path[i - 1].positions[axis]));
            if (steps * 65'535 < ticks) slow_steps = std::max(slow_steps, steps);
            fast_steps = std::max(fast_steps, steps);
        }
    }
    const double apart = kCircle.speed / kSecond * fast_steps;
    return circle_deviation(kCircle, path) + apart + std::sqrt(2.0) + slow_steps;
}

TEST(CircleOnALine, StaysOnItAndEndsWhereItBegan) {
    RackWire wire({{registers::midi::Model::mac34_1, 0}, {registers::midi::Model::mac34_1, 1}});
    V24Link link(wire);
    Master master(link);
    Pen pen;
    wire.on_step = [&] { pen.draw(wire.rack.module(0).position(), wire.rack.module(1).position()); };
    const auto path = circle_path(kCircle);
    const auto [plan, error] = plan_path({0, 1}, path);
    ASSERT_EQ(error, "");
    play(master, plan);
    EXPECT_EQ(wire.rack.module(0).position(), 0);
    EXPECT_EQ(wire.rack.module(1).position(), 0);
    pen.expect_circle(bound_for(path));
}

TEST(CircleOnABus, StaysOnItAndEndsWhereItBegan) {
    BusCan can({1, 2});
    CanLink link(can);
    Master master(link);
    Pen pen;
    can.on_step = [&] { pen.draw(can.modules[0].position(), can.modules[1].position()); };
    const auto path = circle_path(kCircle);
    const auto [plan, error] = plan_path({1, 2}, path);
    ASSERT_EQ(error, "");
    play(master, plan);
    EXPECT_EQ(can.modules[0].position(), 0);
    EXPECT_EQ(can.modules[1].position(), 0);
    pen.expect_circle(bound_for(path));
}

TEST(CircleOnALine, TenTurnsDoNotDriftApart) {
    RackWire wire({{registers::midi::Model::mac34_1, 0}, {registers::midi::Model::mac34_1, 1}});
    V24Link link(wire);
    Master master(link);
    Pen pen;
    wire.on_step = [&] { pen.draw(wire.rack.module(0).position(), wire.rack.module(1).position()); };
    Circle circle = kCircle;
    circle.turns = 10;
    circle.clockwise = true;
    const auto path = circle_path(circle);
    play(master, plan_path({0, 1}, path).plan);
    EXPECT_EQ(wire.rack.module(0).position(), 0);
    EXPECT_EQ(wire.rack.module(1).position(), 0);
    pen.expect_circle(bound_for(path));
}

}  // namespace
}  // namespace nplc::midi_client
