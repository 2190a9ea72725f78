// The causes reported for a motion, with images and surveys written by hand.
#include "faces/why_keeper.h"

#include <gtest/gtest.h>

#include "registers/gateway.h"

namespace nplc::faces {
namespace {

namespace gw = registers::gateway;
using namespace std::chrono_literals;

constexpr base::Instant kBegin{100s};

struct Axis {
    Axis() {
        image.number = 1;
        image.own[gw::STATUS] = gw::kLinkDelivers;
        at(kBegin);
    }
    void at(base::Instant now) { image.taken = now; }
    void read(MotorItem item, std::int32_t value) {
        image.motor[static_cast<std::size_t>(item)] = {true, value, image.taken};
    }
    void begin_motion() {
        image.moves = true;
        image.moving_since = image.taken;
    }
    /// A survey of now: P_IST goes on by `way`, V_IST is `velocity`.
    void survey(std::int64_t way, std::int64_t velocity) {
        auto made = std::make_shared<Survey>();
        made->taken = image.taken;
        for (const registers::Register* reg : causes::judged(made->model)) made->now.set(reg->number, 0, {});
        for (const registers::Register* reg : causes::judged_before(made->model))
            made->before.set(reg->number, 0, {});
        set(made->now, "P_IST", way);
        set(made->now, "V_IST", velocity);
        set(made->before, "V_IST", velocity);
        set(made->now, "MODE_REG", 2);
        set(made->now, "V_SOLL", 3'000);
        set(made->now, "P_SOLL", 100'000);
        set(made->now, "P_FNC", 16 * way);
        last = made;
    }
    void set(causes::Snapshot& to, std::string_view name, std::int64_t value) const {
        to.set(registers::find(registers::Model::mac140, name)->number, value, {});
    }
    std::string first() {
        const auto found = keeper.look(image, image.taken, last);
        return found == nullptr ? "" : found->front().code + ": " + found->front().sentence;
    }

    AxisImage image;
    std::shared_ptr<const Survey> last;
    WhyKeeper keeper;
};

// V_IST counts 10 rpm as 1.31072 (001 section 3.2.12): 60 are 457.8 rpm.
TEST(WhyKeeper, TellsTheVelocityOfTheMotionAndNotThatBeforeIt) {
    Axis axis;
    axis.survey(0, 0);
    axis.read(MotorItem::velocity, 0);
    EXPECT_EQ(axis.first().find("moves: "), std::string::npos);
    axis.at(kBegin + 100ms);
    axis.begin_motion();
    EXPECT_EQ(axis.first(), "moves: It moves.");
    axis.at(kBegin + 200ms);
    axis.read(MotorItem::velocity, 60);
    const std::string told = axis.first();
    EXPECT_EQ(told.find("moves: It moves: V_IST 457.8 rpm"), 0U) << told;
    axis.read(MotorItem::velocity, 63);
    EXPECT_EQ(axis.first(), told) << "not another text for each read";
    axis.read(MotorItem::velocity, 120);
    EXPECT_EQ(axis.first().find("moves: It moves: V_IST 915.5 rpm"), 0U) << axis.first();
    axis.read(MotorItem::velocity, 0);
    EXPECT_EQ(axis.first(), "moves: It moves.");
}

TEST(WhyKeeper, ASurveyOfAMotionIsNotToldOfAnAxisThatStands) {
    Axis axis;
    axis.survey(5'000, 60);
    axis.begin_motion();
    axis.read(MotorItem::velocity, 60);
    EXPECT_EQ(axis.first().find("moves: It moves: V_IST 457.8 rpm"), 0U) << axis.first();
    axis.at(kBegin + 500ms);
    axis.image.moves = false;
    axis.read(MotorItem::position, 9'000);
    axis.read(MotorItem::velocity, 0);
    EXPECT_EQ(axis.first().find("moves"), std::string::npos) << axis.first();
    axis.at(kBegin + 3s);
    axis.survey(0, 0);
    EXPECT_NE(axis.first(), "");
    EXPECT_NE(axis.first().find("moves: "), 0U);
}

}  // namespace
}  // namespace nplc::faces
