// A stop is done only when the motor has confirmed it since it was asked.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "registers/mac.h"
#include "sim/world.h"
#include "tables.h"

namespace nplc::sim {
namespace {

using namespace std::chrono_literals;
using gateway::Event;
using gateway::RunState;
using registers::MODE_REG;

struct Bench {
    explicit Bench(bool is_safe) : world(turning_table(), options(is_safe)) {}

    static WorldOptions options(bool is_safe) {
        WorldOptions options;
        options.safe_communication = is_safe;
        return options;
    }
    void run_for(Time time) {
        const Time end = world.now() + time;
        while (world.now() < end) world.step(end);
    }
    void turn() {
        run_for(1s);
        ASSERT_EQ(reg(MODE_REG), 1);
        ASSERT_GT(reg(registers::V_IST), 20);
    }
    void lose(bool to_motor, bool from_motor, double share) {
        action::SpoilLine faults;
        faults.to_motor = to_motor;
        faults.from_motor = from_motor;
        faults.drop = share;
        world.spoil_line(faults);
    }
    std::int32_t reg(std::uint8_t number) { return world.mac().read(number); }
    void stop() { world.gateway(action::Gateway::stop); }
    const gateway::Gateway& controller() const { return world.gateway(); }
    int count(Event event) const {
        const auto& log = controller().log();
        int found = 0;
        const std::uint32_t kept = std::min<std::uint32_t>(log.count(), gateway::EventLog::kSlots);
        for (std::uint32_t i = 0; i < kept; ++i)
            found += log.slot(i).event == static_cast<std::uint8_t>(event) ? 1 : 0;
        return found;
    }

    unsigned detail(Event event) const {
        for (std::size_t i = 0; i < gateway::EventLog::kSlots; ++i)
            if (controller().log().slot(i).event == static_cast<std::uint8_t>(event))
                return controller().log().slot(i).detail;
        return 0;
    }

    World world;
};

struct StopConfirmation : testing::TestWithParam<bool>, Bench {
    StopConfirmation() : Bench(GetParam()) {}
};

TEST_P(StopConfirmation, ComesAtOnceOnALineInOrder) {
    turn();
    stop();
    EXPECT_TRUE(controller().stop_unconfirmed()) << "asked, and not on the wire yet";
    run_for(50ms);
    EXPECT_FALSE(controller().stop_unconfirmed());
    EXPECT_EQ(reg(MODE_REG), 0);
    EXPECT_EQ(count(Event::stop_confirmed), 1);
}

// More than 40 ms: the link is lost, and the log has the reason.
TEST_P(StopConfirmation, NeverComesOverALineThatIsTooLateWhichTheLogNames) {
    turn();
    EXPECT_EQ(count(Event::line_late), 0);
    action::SpoilLine faults;
    faults.to_motor = faults.from_motor = true;
    faults.late = 30ms;
    world.spoil_line(faults);
    run_for(3s);
    EXPECT_EQ(count(Event::line_late), 1);
    EXPECT_GT(detail(Event::line_late), 55U);
    EXPECT_LT(detail(Event::line_late), 70U);
    stop();
    run_for(2s);
    EXPECT_EQ(reg(MODE_REG), 0) << "told blind";
    EXPECT_TRUE(controller().stop_unconfirmed());
    faults.late = 0ms;
    world.spoil_line(faults);
    run_for(2s);
    EXPECT_FALSE(controller().stop_unconfirmed());
    EXPECT_EQ(count(Event::line_late), 1);
}

// The motor receives but its answers are lost: the stop is sent blind, and is not reported as done.
TEST_P(StopConfirmation, NeverComesFromAMotorThatIsNotHeard) {
    turn();
    lose(false, true, 1);
    stop();
    run_for(1s);
    EXPECT_EQ(reg(MODE_REG), 0) << "told without an answer";
    EXPECT_TRUE(controller().stop_unconfirmed());
    EXPECT_EQ(count(Event::stop_confirmed), 0);
    EXPECT_EQ(world.controller().sequence().run().error(), base::Error::stop_unconfirmed);
    lose(false, true, 0);
    run_for(1s);
    EXPECT_FALSE(controller().stop_unconfirmed());
    EXPECT_EQ(count(Event::stop_confirmed), 1);
    EXPECT_TRUE(world.controller().sequence().run().ok());
}

// No client has requested a stop: the safe state of a lost link does.
TEST_P(StopConfirmation, IsWantedAsSoonAsTheLinkIsLost) {
    turn();
    lose(false, true, 1);
    run_for(1s);
    EXPECT_EQ(controller().run_state(), RunState::running);
    EXPECT_EQ(controller().safe_reason(), gateway::SafeReason::link_down);
    EXPECT_EQ(reg(MODE_REG), 0) << "told without an answer";
    EXPECT_TRUE(controller().stop_unconfirmed());
    lose(false, true, 0);
    run_for(1s);
    EXPECT_FALSE(controller().stop_unconfirmed());
}

// Given up while the line is cut: the stop is sent once more as soon as the motor receives.
TEST_P(StopConfirmation, IsWantedAnewWhenALostLinkIsBack) {
    turn();
    world.cut_line(true);
    run_for(500ms);
    world.controller().sequence().give_up_stop();
    EXPECT_FALSE(controller().stop_unconfirmed());
    EXPECT_EQ(reg(MODE_REG), 1) << "it turns on";
    world.cut_line(false);
    run_for(1s);
    EXPECT_EQ(reg(MODE_REG), 0);
    EXPECT_FALSE(controller().stop_unconfirmed());
}

// Its status bytes run on, valid and equal: they prove nothing.
TEST_P(StopConfirmation, NeverComesFromAMotorThatDoesNotHear) {
    turn();
    lose(true, false, 1);
    stop();
    run_for(2s);
    EXPECT_EQ(reg(MODE_REG), 1) << "it turns on";
    EXPECT_TRUE(controller().stop_unconfirmed());
    EXPECT_EQ(world.controller().sequence().run().error(), base::Error::stop_unconfirmed);
    lose(true, false, 0);
    run_for(1s);
    EXPECT_EQ(reg(MODE_REG), 0);
    EXPECT_FALSE(controller().stop_unconfirmed());
}

// Two damaged status bytes in a row look like an echo while the motor has heard nothing.
TEST_P(StopConfirmation, IsNotMadeOfDamagedStatusBytes) {
    int confirmed = 0;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        Bench bench(GetParam());
        bench.world.seed(seed);
        bench.turn();
        action::SpoilLine faults;
        faults.to_motor = true;
        faults.drop = 0.05;
        bench.world.spoil_line(faults);
        faults = {};
        faults.from_motor = true;
        faults.damage = 0.05;
        bench.world.spoil_line(faults);
        bench.stop();
        const Time end = bench.world.now() + 500ms;
        while (bench.world.now() < end && bench.controller().stop_unconfirmed()) bench.world.step(end);
        if (bench.controller().stop_unconfirmed()) continue;
        ++confirmed;
        EXPECT_TRUE(bench.reg(MODE_REG) == 0 || bench.reg(MODE_REG) == 11) << "seed " << seed;
    }
    EXPECT_GT(confirmed, 50);
}

TEST_P(StopConfirmation, IsWaitedForAfterACutLineToo) {
    turn();
    world.cut_line(true);
    run_for(100ms);
    stop();
    run_for(5s);
    EXPECT_TRUE(controller().stop_unconfirmed());
    EXPECT_EQ(reg(MODE_REG), 1);
    world.cut_line(false);
    run_for(2s);
    EXPECT_FALSE(controller().stop_unconfirmed());
    EXPECT_EQ(reg(MODE_REG), 0);
}

TEST_P(StopConfirmation, IsGivenUpByAnOperator) {
    turn();
    world.cut_line(true);
    stop();
    run_for(500ms);
    ASSERT_TRUE(controller().stop_unconfirmed());
    world.controller().sequence().give_up_stop();
    EXPECT_FALSE(controller().stop_unconfirmed());
    world.cut_line(false);
    run_for(1s);
    EXPECT_EQ(reg(MODE_REG), 1) << "it was given up: nothing is told late";
    EXPECT_EQ(count(Event::stop_confirmed), 0);
}

// Whatever stops it is a stop that has to be confirmed.
TEST_P(StopConfirmation, IsNeededForTheSafeStateAndForAHold) {
    turn();
    lose(false, true, 1);
    run_for(100ms);
    world.controller().sequence().enter_safe_state_by_command(world.instant());
    run_for(1s);
    EXPECT_TRUE(controller().stop_unconfirmed());
    EXPECT_EQ(reg(MODE_REG), 0);
}

INSTANTIATE_TEST_SUITE_P(Communication, StopConfirmation, testing::Bool(),
                         [](const auto& safe) { return safe.param ? "Safe" : "Rapid"; });

}  // namespace
}  // namespace nplc::sim
