// What the gateway must never do, as far as its loop goes; the link's part is in tests/motor.

#include <gtest/gtest.h>

#include "bench_board.h"
#include "gateway/gateway.h"

namespace nplc::gateway {
namespace {

const Bytes kOutputsOn{{0xC0, 0x00, 0x00, 0x3E, 0x80, 0x0F, 0, 0}};

struct Safety : testing::Test {
    BenchBoard board;
    const Settings settings{.safe_outputs = 0x02};

    void expect_safe(const Gateway& gateway, SafeReason reason) const {
        EXPECT_EQ(gateway.safe_reason(), reason);
        EXPECT_EQ(board.out, 0x02);
    }
};

TEST_F(Safety, OutputsAreSafeFromConstructionToTheFirstScan) {
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    expect_safe(gateway, SafeReason::not_started);
    board.link_state = motor::Link::down;
    ASSERT_TRUE(gateway.load(kOutputsOn, board.now).ok);
    board.run(gateway, 1s);
    expect_safe(gateway, SafeReason::not_started);
    EXPECT_EQ(gateway.run_state(), RunState::waiting_for_motor);
    EXPECT_EQ(gateway.scans(), 0U);
    board.link_state = motor::Link::up;
    board.run(gateway, 1ms);
    EXPECT_EQ(board.out, 0x0F);
    EXPECT_EQ(gateway.safe_reason(), SafeReason::none);
}

TEST_F(Safety, TheMotorIsStoppedBeforeTheFirstScanAfterAnyStart) {
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    ASSERT_TRUE(gateway.load(kOutputsOn, board.now).ok);
    board.is_settled = false;
    board.run(gateway, 100ms);
    EXPECT_EQ(board.stops, 1);
    EXPECT_EQ(gateway.scans(), 0U) << "not before the motor has taken it";
    board.is_settled = true;
    board.run(gateway, 1ms);
    EXPECT_GT(gateway.scans(), 0U);
    gateway.stop(board.now);
    EXPECT_EQ(board.stops, 2);
    ASSERT_TRUE(gateway.run().ok());
    board.run(gateway, 1ms);
    EXPECT_EQ(board.stops, 3);
}

TEST_F(Safety, TheMotorIsLeftAloneWithOnStartKeep) {
    Gateway gateway(board.ports(), {.on_start = OnStart::keep}, StartCause::power_up);
    ASSERT_TRUE(gateway.load(kOutputsOn, board.now).ok);
    board.run(gateway, 10ms);
    EXPECT_EQ(board.stops, 0);
    EXPECT_GT(gateway.scans(), 0U);
}

TEST_F(Safety, AfterAWatchdogResetTheSequenceDoesNotStartByItself) {
    Gateway gateway(board.ports(), settings, StartCause::watchdog);
    EXPECT_EQ(board.stops, 1);
    ASSERT_TRUE(gateway.load(kOutputsOn, board.now).ok);
    board.run(gateway, 1s);
    expect_safe(gateway, SafeReason::watchdog);
    ASSERT_EQ(gateway.log().count(), 1U);
    EXPECT_EQ(gateway.scans(), 0U);
    ASSERT_TRUE(gateway.run().ok());
    board.run(gateway, 1ms);
    EXPECT_EQ(board.out, 0x0F);
}

TEST_F(Safety, InServiceNothingRunsAndOutputsStaySafe) {
    Gateway gateway(board.ports(), settings, StartCause::service);
    EXPECT_TRUE(gateway.load(kOutputsOn, board.now).ok);
    for (const auto start : {&Gateway::run, &Gateway::scan_once, &Gateway::step_once}) {
        const base::Status started = (gateway.*start)();
        ASSERT_FALSE(started.ok());
        EXPECT_EQ(started.error(), base::Error::not_enabled);
        board.run(gateway, 100ms);
    }
    EXPECT_FALSE(gateway.enabled());
    EXPECT_EQ(gateway.scans(), 0U);
    EXPECT_TRUE(board.sent.empty());
    expect_safe(gateway, SafeReason::not_started);
    ASSERT_TRUE(gateway.change(settings).ok());
    EXPECT_FALSE(gateway.enabled()) << "no setting ends it";
}

TEST_F(Safety, ServiceThatBeginsWhileStoppedLastsUntilTheNextStart) {
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    ASSERT_TRUE(gateway.load(kOutputsOn, board.now).ok);
    board.run(gateway, 10ms);
    EXPECT_EQ(board.out, 0x0F);
    gateway.stop(board.now);
    gateway.begin_service();
    EXPECT_TRUE(gateway.is_in_service());
    EXPECT_FALSE(gateway.enabled());
    EXPECT_EQ(gateway.run().error(), base::Error::not_enabled);
    ASSERT_TRUE(gateway.load(kOutputsOn, board.now).ok);
    board.run(gateway, 1s);
    EXPECT_EQ(gateway.run_state(), RunState::stopped);
    EXPECT_EQ(board.out, 0x02);
}

TEST_F(Safety, ALostLinkIsTheSafeStateUntilTheSequenceHasAcknowledged) {
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    ASSERT_TRUE(gateway.load(kOutputsOn, board.now).ok);
    board.run(gateway, 10ms);
    board.stops = 0;
    board.link_state = motor::Link::down;
    const auto lost = board.now;
    board.run(gateway, 10ms);
    expect_safe(gateway, SafeReason::link_down);
    EXPECT_LE(board.out_since - lost, 10ms);
    EXPECT_EQ(gateway.safe_since(), board.out_since);
    EXPECT_EQ(gateway.run_state(), RunState::running) << "the sequence sees ERROR and can react";
    EXPECT_NE(gateway.image() & sequencer::kError, 0);
    EXPECT_EQ(board.stops, 1) << "told at once: it may hear though it is not heard";
    board.link_state = motor::Link::unacknowledged;
    board.run(gateway, 10ms);
    expect_safe(gateway, SafeReason::link_down);
    EXPECT_EQ(board.stops, 2) << "told once more as soon as the line works";
    board.link_state = motor::Link::up;
    board.run(gateway, 1ms);
    EXPECT_EQ(gateway.safe_reason(), SafeReason::none);
    EXPECT_EQ(board.out, 0x0F);
}

TEST_F(Safety, StopCommandIsTheSafeStateAtOnce) {
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    ASSERT_TRUE(gateway.load(kOutputsOn, board.now).ok);
    board.run(gateway, 10ms);
    board.stops = 0;
    gateway.stop(board.now);
    expect_safe(gateway, SafeReason::stop_command);
    EXPECT_EQ(board.stops, 1);
    const auto scans = gateway.scans();
    board.run(gateway, 1s);
    EXPECT_EQ(gateway.scans(), scans);
    expect_safe(gateway, SafeReason::stop_command);
}

TEST_F(Safety, LosingTheEnableInputStops) {
    Gateway gateway(board.ports(), {.safe_outputs = 0x02, .enable_input = 5}, StartCause::power_up);
    board.in = 0x20;
    ASSERT_TRUE(gateway.load(kOutputsOn, board.now).ok);
    board.run(gateway, 10ms);
    EXPECT_EQ(board.out, 0x0F);
    board.in = 0;
    const auto lost = board.now;
    board.run(gateway, 10ms);
    expect_safe(gateway, SafeReason::enable_lost);
    EXPECT_LE(board.out_since - lost, 10ms);
    board.in = 0x20;
    board.run(gateway, 100ms);
    expect_safe(gateway, SafeReason::enable_lost);
    ASSERT_TRUE(gateway.run().ok());
    board.run(gateway, 1ms);
    EXPECT_EQ(board.out, 0x0F);
}

TEST_F(Safety, ALongDebounceDoesNotDelayTheLossOfTheEnableInput) {
    Gateway gateway(board.ports(), {.safe_outputs = 0x02, .enable_input = 5, .debounce = 50ms},
                    StartCause::power_up);
    board.in = 0x20;
    ASSERT_TRUE(gateway.load(kOutputsOn, board.now).ok);
    board.run(gateway, 100ms);
    EXPECT_EQ(board.out, 0x0F);
    board.in = 0;
    const auto lost = board.now;
    board.run(gateway, 8ms);
    EXPECT_EQ(board.out, 0x0F) << "a short drop is none";
    board.run(gateway, 2ms);
    expect_safe(gateway, SafeReason::enable_lost);
    EXPECT_LE(board.out_since - lost, 10ms);
    board.in = 0x20;
    board.run(gateway, 20ms);
    expect_safe(gateway, SafeReason::enable_lost);
    EXPECT_TRUE(gateway.run().ok());
}

TEST_F(Safety, TheEnableInputItselfStartsNothing) {
    Gateway gateway(board.ports(), {.safe_outputs = 0x02, .enable_input = 5}, StartCause::power_up);
    ASSERT_TRUE(gateway.load(kOutputsOn, board.now).ok);
    board.run(gateway, 10ms);
    EXPECT_EQ(gateway.run_state(), RunState::stopped) << "autostart does not wait for it";
    expect_safe(gateway, SafeReason::enable_lost);
    EXPECT_EQ(gateway.run().error(), base::Error::not_enabled);
    EXPECT_EQ(gateway.step_once().error(), base::Error::not_enabled);
    EXPECT_EQ(gateway.scan_once().error(), base::Error::not_enabled);
    board.in = 0x20;
    board.run(gateway, 1s);
    EXPECT_EQ(gateway.run_state(), RunState::stopped);
    expect_safe(gateway, SafeReason::enable_lost);
    EXPECT_EQ(gateway.scans(), 0U);
    ASSERT_TRUE(gateway.run().ok());
    board.run(gateway, 1ms);
    EXPECT_EQ(board.out, 0x0F);
}

TEST_F(Safety, AStartThatWaitsForTheMotorEndsWithTheEnableInput) {
    Gateway gateway(board.ports(), {.safe_outputs = 0x02, .enable_input = 5}, StartCause::power_up);
    board.in = 0x20;
    board.link_state = motor::Link::down;
    ASSERT_TRUE(gateway.load(kOutputsOn, board.now).ok);
    board.run(gateway, 10ms);
    ASSERT_EQ(gateway.run_state(), RunState::waiting_for_motor);
    board.in = 0;
    board.run(gateway, 10ms);
    board.in = 0x20;
    board.link_state = motor::Link::up;
    board.run(gateway, 1s);
    EXPECT_EQ(gateway.run_state(), RunState::stopped);
    expect_safe(gateway, SafeReason::enable_lost);
}

TEST_F(Safety, AfterALostLinkTheMotorIsStoppedBeforeTheSequenceGoesOn) {
    const Bytes sends{{0xC0, 0x00, 0x00, 0x3E, 0x60, 0x0F, 0, 0}};
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    board.room = -1;
    ASSERT_TRUE(gateway.load(sends, board.now).ok);
    board.run(gateway, 10ms);
    board.link_state = motor::Link::down;
    board.run(gateway, 10ms);
    board.stops = 0;
    board.sent.clear();
    board.link_state = motor::Link::unacknowledged;
    board.is_settled = false;  // as a driver that has to send the stop
    board.run(gateway, 10ms);
    EXPECT_EQ(board.stops, 1);
    EXPECT_TRUE(board.sent.empty());
    board.is_settled = true;
    board.run(gateway, 10ms);
    EXPECT_EQ(board.stops, 1);
}

TEST_F(Safety, AnEnableInputThatDoesNotExistNeverEnables) {
    Gateway gateway(board.ports(), {.safe_outputs = 0x02, .enable_input = 200}, StartCause::power_up);
    ASSERT_TRUE(gateway.load(kOutputsOn, board.now).ok);
    board.in = 0x3F;
    board.run(gateway, 100ms);
    EXPECT_EQ(gateway.run().error(), base::Error::not_enabled);
    expect_safe(gateway, SafeReason::enable_lost);
}

TEST_F(Safety, ABadTableIsTheSafeStateAndNothingRuns) {
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    const Bytes bad{{0xC0, 0, 0, 0x3F, 0x80, 0, 0, 0}};
    const auto result = gateway.load(bad, board.now);
    EXPECT_FALSE(result.ok);
    EXPECT_EQ(result.fault.error, base::Error::bad_next_step);
    EXPECT_EQ(result.fault.term, 0);
    expect_safe(gateway, SafeReason::bad_table);
    EXPECT_EQ(board.stops, 1);
    EXPECT_EQ(gateway.run().error(), base::Error::no_table);
    ASSERT_TRUE(gateway.load(kOutputsOn, board.now).ok);
    board.run(gateway, 100ms);
    EXPECT_EQ(gateway.run_state(), RunState::stopped) << "a good table after a bad one needs run()";
}

TEST_F(Safety, ATableForAnotherMotorIsABadTable) {
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    board.missing_register = 5;
    const Bytes writes{{0xC0, 0x00, 0x00, 0x3E, 0x80, 0, 0, 0}, {0xC0, 0x00, 0x80, 0x05, 0x64, 0, 0, 0}};
    const auto result = gateway.load(writes, board.now);
    EXPECT_FALSE(result.ok);
    EXPECT_EQ(result.fault.error, base::Error::not_for_motor);
    EXPECT_EQ(result.fault.term, 1);
    expect_safe(gateway, SafeReason::bad_table);
    EXPECT_EQ(gateway.run().error(), base::Error::no_table);
}

TEST_F(Safety, StartingAnewDoesNotAcknowledgeALostLink) {
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    ASSERT_TRUE(gateway.load(kOutputsOn, board.now).ok);
    board.run(gateway, 10ms);
    board.link_state = motor::Link::down;
    board.run(gateway, 10ms);
    gateway.stop(board.now);
    board.link_state = motor::Link::unacknowledged;
    ASSERT_TRUE(gateway.run().ok());
    board.run(gateway, 10ms);
    EXPECT_EQ(gateway.run_state(), RunState::running);
    expect_safe(gateway, SafeReason::link_down);
    board.link_state = motor::Link::up;
    board.run(gateway, 10ms);
    EXPECT_EQ(board.out, 0x0F);
}

TEST_F(Safety, EveryWaitForTheMotorEnds) {
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    ASSERT_TRUE(gateway.load(kOutputsOn, board.now).ok);
    board.run(gateway, 10ms);
    board.is_settled = false;
    board.run(gateway, 990ms);
    EXPECT_EQ(gateway.run_state(), RunState::running);
    board.stops = 0;
    board.run(gateway, 20ms);
    expect_safe(gateway, SafeReason::motor_stuck);
    EXPECT_EQ(board.stops, 1);
    EXPECT_EQ(gateway.run_state(), RunState::stopped);
}

TEST_F(Safety, AHaltedScanEndsToo) {
    const Bytes sends{{0xC0, 0x00, 0x00, 0x3E, 0x60, 0x0F, 0, 0}};
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    board.room = 0;
    ASSERT_TRUE(gateway.load(sends, board.now).ok);
    board.run(gateway, 10ms);
    ASSERT_EQ(gateway.run_state(), RunState::running);
    board.feeds = board.stops = 0;
    board.run(gateway, 900ms);
    EXPECT_EQ(board.feeds, 0);
    EXPECT_EQ(gateway.run_state(), RunState::running);
    board.run(gateway, 200ms);
    expect_safe(gateway, SafeReason::motor_stuck);
    EXPECT_EQ(board.stops, 1);
    EXPECT_TRUE(board.sent.empty());
}

/// An alarm lamp among the safe levels is lit from the loss of the link on, what the fault step writes only
/// later.
TEST_F(Safety, ALampInTheSafeOutputsIsLitWhileTheLinkIsDown) {
    constexpr std::uint8_t kLamp = 8;
    // Step 0: outputs 1, to step 1; on ERROR (input bit 7) to step 2 with outputs 4.
    const Bytes table{{0xC0, 0x00, 0x00, 0x01, 0x80, 0x01, 0, 0}, {0xC1, 0x80, 0x00, 0x02, 0x80, 0x04, 0, 0}};
    Gateway gateway(board.ports(), {.safe_outputs = kLamp}, StartCause::power_up);
    ASSERT_TRUE(gateway.load(table, board.now).ok);
    board.run(gateway, 10ms);
    EXPECT_EQ(board.out, 1);
    board.link_state = motor::Link::down;
    board.run(gateway, 10ms);
    EXPECT_EQ(gateway.state().step, 2);
    EXPECT_EQ(board.out, kLamp);
    board.link_state = motor::Link::unacknowledged;
    board.run(gateway, 10ms);
    EXPECT_EQ(board.out, kLamp);
    board.link_state = motor::Link::up;
    board.run(gateway, 10ms);
    EXPECT_EQ(board.out, 4);
}

TEST_F(Safety, AFaultOfTheDriverIsNotedOnce) {
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    ASSERT_TRUE(gateway.load(kOutputsOn, board.now).ok);
    board.run(gateway, 10ms);
    const std::uint32_t before = gateway.log().count();
    board.fault = 11;
    board.run(gateway, 10ms);
    ASSERT_EQ(gateway.log().count(), before + 1);
    EXPECT_EQ(gateway.log().slot(before).event, static_cast<std::uint8_t>(Event::motor_fault));
    EXPECT_EQ(gateway.log().slot(before).detail, 11);
    board.fault = 0;
    board.run(gateway, 10ms);
    EXPECT_EQ(gateway.log().count(), before + 1);
}

TEST_F(Safety, OnlyAFinishedScanFeedsTheWatchdogOfARunningSequence) {
    Gateway gateway(board.ports(), settings, StartCause::power_up);
    ASSERT_TRUE(gateway.load(kOutputsOn, board.now).ok);
    board.run(gateway, 10ms);
    EXPECT_EQ(board.feeds, 40) << "a feed a poll: waiting, scanned or nothing to scan";
    board.is_settled = false;
    board.feeds = 0;
    board.run(gateway, 100ms);
    EXPECT_EQ(board.feeds, 0);
}

}  // namespace
}  // namespace nplc::gateway
