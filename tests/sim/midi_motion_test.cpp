#include <tuple>

#include "midi_bench.h"

namespace nplc::sim {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

// 48000 / 480 = 100 rpm; 10000 increments with AA 16 are 480 x (240 x 16 x 2 + 10000 - 3840) ticks of 0.125
// us: 830.4 ms.
TEST(MidiMotion, AMoveTakesItsTimeAndEndsExactly) {
    MidiBench bench;
    EXPECT_TRUE(bench.order(midi::GO_TO, 10'000));
    EXPECT_TRUE(bench->moving());
    EXPECT_TRUE(bench->busy());
    bench.run_out();
    EXPECT_EQ(bench->position(), 10'000);
    EXPECT_FALSE(bench->busy());
    const auto took = std::chrono::duration_cast<microseconds>(bench.now());
    EXPECT_NEAR(static_cast<double>(took.count()), 830'400, 20);
    EXPECT_EQ(bench.ask(midi::GET_POSITION), 10'000U);
    EXPECT_TRUE(bench.order(midi::GO_TO_ZERO));
    bench.run_out();
    EXPECT_EQ(bench->position(), 0);
}

TEST(MidiMotion, NegativePositions) {
    MidiBench bench;
    EXPECT_TRUE(bench.order(midi::GO_TO, -1'000));
    bench.run_out();
    EXPECT_EQ(bench.ask(midi::GET_POSITION), 0xFFFFFC18U);
}

// Both manuals' marks.
TEST(MidiMotion, WhatIsRefusedWhileItMoves) {
    MidiBench bench;
    ASSERT_TRUE(bench.order(midi::GO_TO, 100'000));
    bench.pass(milliseconds{50});
    for (const auto& [number, value] :
         {std::pair{midi::STOP_TORQUE, 0}, std::pair{midi::END_STOPS, 9}, std::pair{midi::UPPER_STOP, 5},
          std::pair{midi::LOWER_STOP, 5}, std::pair{midi::SPEED, 100}, std::pair{midi::RAMP, 3},
          std::pair{midi::GO_TO, 7}, std::pair{midi::GO_TO_ZERO, 0}})
        EXPECT_FALSE(bench.order(number, value)) << int{number};
    EXPECT_FALSE(bench.order(midi::RUN, 0, 100));       // R
    EXPECT_FALSE(bench.order(midi::SEGMENT, 10, 100));  // R
    for (const auto& [number, value] : {std::pair{midi::TORQUE, 0x20}, std::pair{midi::UNSTALL, 9},
                                        std::pair{midi::TOLERANCE, 1}, std::pair{midi::REFERENCE, 1}})
        EXPECT_TRUE(bench.order(number, value)) << int{number};
    EXPECT_TRUE(bench->moving());
    bench.run_out();
    EXPECT_EQ(bench->position(), 100'000);
    EXPECT_EQ(bench->memory().period, 480);
    EXPECT_TRUE(bench.order(midi::SPEED, 100));
}

TEST(MidiMotion, UnknownNumbersAndParametersAreRefused) {
    MidiBench bench;
    for (const int number : {0x04, 0x05, 0x06, 0x12, 0x1D, 0x1F, 0x20, 0xFF})
        EXPECT_FALSE(bench->execute(static_cast<std::uint8_t>(number), 0, 0)) << number;
    EXPECT_FALSE(bench->execute(midi::GO_TO, 1, 5));  // R: sub-index
    EXPECT_FALSE(bench->execute(midi::END_STOPS, 0, 5));
    EXPECT_FALSE(bench->execute(midi::SPEED, 0, 0));
    EXPECT_FALSE(bench->execute(midi::BAUD, 0, 4));
    EXPECT_FALSE(bench->execute(midi::TORQUE, 0, 0x81));
    EXPECT_FALSE(bench->answer(10, 0));
    MidiBench weak(midi::Model::mac34_1, {.imax = 0x60});
    EXPECT_FALSE(weak.order(midi::TORQUE, 0x61));
    EXPECT_TRUE(weak.order(midi::TORQUE, 0x60));
    EXPECT_EQ(weak.ask(midi::GET_RAM, midi::kImaxAddress), 0x60000000U);  // 000 §VI 28h
    EXPECT_EQ(weak.ask(midi::GET_RAM, midi::kImaxAddress - 1), 0x00600000U);
}

// 000 §VI 15h.
TEST(MidiMotion, ARunKeepsItsDirectionAndEndsWithPeriodZero) {
    MidiBench bench;
    EXPECT_TRUE(bench.order(midi::RUN, midi::kTurnsLeft, 480));
    bench.pass(seconds{1});
    const std::int32_t there = bench->position();
    EXPECT_LT(there, -10'000);
    EXPECT_TRUE(bench.order(midi::RUN, 0, 240));  // to the right: the direction stays
    bench.pass(seconds{1});
    const std::int32_t before = bench->position();
    EXPECT_LT(before, there);
    bench.pass(milliseconds{60});
    EXPECT_EQ(bench->position(), before - 2'000);  // 8 MHz / 240 = 33333 a second
    EXPECT_TRUE(bench.order(midi::RUN, 0, 0));
    const std::int32_t stopping = bench->position();
    bench.run_out();
    EXPECT_EQ(bench->position(), stopping - 120 * 16);
    EXPECT_TRUE(bench.order(midi::RUN, 0x55, 480));  // every other SS is clockwise
    bench.pass(seconds{1});
    EXPECT_GT(bench->position(), stopping);
    EXPECT_TRUE(bench.order(midi::STOP));
    bench.run_out();
}

TEST(MidiMotion, StopWithAndWithoutRamp) {
    MidiBench bench;
    ASSERT_TRUE(bench.order(midi::GO_TO, 1'000'000));
    bench.pass(seconds{2});
    std::int32_t at = bench->position();
    EXPECT_TRUE(bench.order(midi::STOP));
    bench.run_out();
    EXPECT_EQ(bench->position(), at + 120 * 16);
    EXPECT_TRUE(bench->powered());
    EXPECT_FALSE(bench->busy());
    ASSERT_TRUE(bench.order(midi::GO_TO, 1'000'000));
    bench.pass(seconds{1});
    at = bench->position();
    EXPECT_TRUE(bench.order(midi::EMERGENCY_STOP));
    EXPECT_FALSE(bench->moving());
    EXPECT_TRUE(bench->powered());
    bench.pass(seconds{1});
    EXPECT_EQ(bench->position(), at);
}

// 000 §VI 02h, 0Ch, 19h, 1Ah.
TEST(MidiMotion, PowerAndStandby) {
    MidiBench bench;
    EXPECT_FALSE(bench->powered());
    EXPECT_EQ(bench->torque(), 0);
    EXPECT_TRUE(bench.order(midi::POWER_ON));
    EXPECT_EQ(bench->torque(), 0x40);  // half of 80h
    EXPECT_TRUE(bench.order(midi::STOP_TORQUE, 0));
    EXPECT_EQ(bench->torque(), 0x80);
    EXPECT_TRUE(bench.order(midi::STOP_TORQUE, 1));
    EXPECT_TRUE(bench.order(midi::POWER_OFF));
    EXPECT_EQ(bench->torque(), 0);
    EXPECT_TRUE(bench.order(midi::GO_TO, 10'000));  // on by itself
    EXPECT_EQ(bench->torque(), 0x80);
    bench.pass(milliseconds{200});
    EXPECT_TRUE(bench.order(midi::POWER_OFF));
    EXPECT_FALSE(bench->moving());
    EXPECT_FALSE(bench->busy());
}

// 003 §IV: software stops end motion beyond them, and only outwards.
TEST(MidiStops, Software) {
    MidiBench bench;
    ASSERT_TRUE(bench.order(midi::UPPER_STOP, 1'000));
    ASSERT_TRUE(bench.order(midi::LOWER_STOP, -1'000));
    ASSERT_TRUE(bench.order(midi::GO_TO, 2'000));
    bench.run_out();
    EXPECT_EQ(bench->position(), 2'000);  // not enabled
    ASSERT_TRUE(bench.order(midi::END_STOPS, 8));
    ASSERT_TRUE(bench.order(midi::GO_TO, 3'000));
    bench.run_out();
    EXPECT_EQ(bench->position(), 2'000);
    EXPECT_EQ(bench.ask(midi::GET_STATUS), midi::kAtUpperStop);
    ASSERT_TRUE(bench.order(midi::GO_TO, -5'000));
    EXPECT_EQ(bench.ask(midi::GET_STATUS), 0U);
    bench.run_out();
    EXPECT_EQ(bench->position(), -1'001);
    EXPECT_EQ(bench.ask(midi::GET_STATUS), midi::kAtLowerStop);
    EXPECT_EQ(bench.ask(midi::GET_UPPER_STOP), 1'000U);
    EXPECT_EQ(bench.ask(midi::GET_LOWER_STOP), 0xFFFFFC18U);
}

TEST(MidiStops, Hardware) {
    MidiBench bench;
    ASSERT_TRUE(bench.order(midi::END_STOPS, 1));
    ASSERT_TRUE(bench.order(midi::GO_TO, 100'000));
    bench.pass(milliseconds{500});
    bench->set_input(Input::lower_stop, true);  // of the other direction
    bench.pass(milliseconds{10});
    EXPECT_TRUE(bench->moving());
    EXPECT_EQ(bench.ask(midi::GET_MEASURES) & 0xFFFF, midi::kLowerInput);
    bench->set_input(Input::upper_stop, true);
    bench.pass(milliseconds{1});
    EXPECT_FALSE(bench->moving());
    EXPECT_EQ(bench.ask(midi::GET_STATUS), midi::kAtUpperInput);
    EXPECT_EQ(bench.ask(midi::GET_MEASURES) & 0xFFFF, midi::kUpperInput | midi::kNotBusy | midi::kLowerInput);
    bench->set_input(Input::lower_stop, false);
    ASSERT_TRUE(bench.order(midi::GO_TO, 0));
    bench.run_out();
    EXPECT_EQ(bench->position(), 0);
    bench->set_input(Input::lower_stop, true);
    ASSERT_TRUE(bench.order(midi::RUN, midi::kTurnsLeft, 480));
    bench.pass(milliseconds{10});
    EXPECT_EQ(bench.ask(midi::GET_STATUS), midi::kAtLowerInput);
    EXPECT_EQ(bench->position(), 0);
}

// 003 §IV: zero at the edge active to inactive, clockwise only, once 07h allows it.
TEST(MidiReference, ZeroAtTheEdge) {
    MidiBench bench;
    const auto pass_the_switch = [&bench] {
        bench->set_input(Input::reference, true);
        bench.pass(milliseconds{500});
        EXPECT_EQ(bench.ask(midi::GET_MEASURES) & midi::kReferenceInput, midi::kReferenceInput);
        const std::int32_t before = bench->position();
        bench->set_input(Input::reference, false);
        return std::pair{before, bench->position()};
    };
    ASSERT_TRUE(bench.order(midi::RUN, 0, 480));
    auto [before, after] = pass_the_switch();
    EXPECT_EQ(after, before);  // not allowed
    ASSERT_TRUE(bench.order(midi::REFERENCE, 1));
    std::tie(before, after) = pass_the_switch();
    EXPECT_NE(before, 0);
    EXPECT_EQ(after, 0);
    ASSERT_TRUE(bench.order(midi::EMERGENCY_STOP));
    ASSERT_TRUE(bench.order(midi::RUN, midi::kTurnsLeft, 480));
    std::tie(before, after) = pass_the_switch();
    EXPECT_LT(before, 0);
    EXPECT_EQ(after, before);  // counter-clockwise
}

// The target keeps its value in the new coordinates.
TEST(MidiReference, AMoveGoesOnFromTheNewZero) {
    MidiBench bench;
    ASSERT_TRUE(bench.order(midi::REFERENCE, 1));
    ASSERT_TRUE(bench.order(midi::ZERO_POSITION));
    bench->turn_shaft(-50'000);
    bench->set_input(Input::reference, true);
    ASSERT_TRUE(bench.order(midi::GO_TO, 20'000));
    bench.pass(seconds{1});
    bench->set_input(Input::reference, false);
    EXPECT_EQ(bench->position(), 0);
    bench.run_out();
    EXPECT_EQ(bench->position(), 20'000);
    // 0Bh in mid-move is the same (R).
    ASSERT_TRUE(bench.order(midi::ZERO_POSITION));
    ASSERT_TRUE(bench.order(midi::GO_TO, 10'000));
    bench.pass(milliseconds{400});
    ASSERT_TRUE(bench.order(midi::ZERO_POSITION));
    EXPECT_EQ(bench->position(), 0);
    bench.run_out();
    EXPECT_EQ(bench->position(), 10'000);
}

TEST(MidiReference, ATargetThatIsTooNearIsMadeUpFor) {
    MidiBench bench;
    ASSERT_TRUE(bench.order(midi::REFERENCE, 1));
    bench->turn_shaft(-40'000);
    bench->set_input(Input::reference, true);
    ASSERT_TRUE(bench.order(midi::GO_TO, 500));
    bench.pass(seconds{1});
    bench->set_input(Input::reference, false);  // 500 from here, and a ramp has 1920
    std::int32_t farthest = 0;
    for (int i = 0; i < 10'000 && bench->moving(); ++i) {
        bench.pass(milliseconds{1});
        farthest = std::max(farthest, bench->position());
    }
    EXPECT_EQ(farthest, 1'920);
    EXPECT_EQ(bench->position(), 500);
}

// 000 §VI 10h, 11h.
TEST(MidiSync, AMotionWaitsForTheSignal) {
    MidiBench bench;
    EXPECT_TRUE(bench.order(midi::SYNC));  // R: nothing prepared, nothing happens
    EXPECT_TRUE(bench.order(midi::WAIT_SYNC));
    EXPECT_TRUE(bench.order(midi::GO_TO, 1'000));
    bench.pass(seconds{1});
    EXPECT_EQ(bench->position(), 0);
    EXPECT_TRUE(bench.order(midi::SYNC));
    bench.run_out();
    EXPECT_EQ(bench->position(), 1'000);
    EXPECT_TRUE(bench.order(midi::GO_TO, 2'000));  // one motion only
    EXPECT_TRUE(bench->moving());
    bench.run_out();
    EXPECT_TRUE(bench.order(midi::WAIT_SYNC));
    EXPECT_TRUE(bench.order(midi::GO_TO, 5'000));
    EXPECT_TRUE(bench.order(midi::EMERGENCY_STOP));  // R: forgets it
    bench->sync();
    EXPECT_FALSE(bench->moving());
}

// 000 §VI 16h: 1000 increments of 4096 ticks are 512 ms.
TEST(MidiSegments, ThreeWaitBesideTheRunning) {
    MidiBench bench;
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(bench.order(midi::SEGMENT, 1'000, 0x1000)) << i;
    EXPECT_FALSE(bench.order(midi::SEGMENT, 1'000, 0x1000));
    EXPECT_FALSE(bench.order(midi::PAUSE, 1'000, 0x1000));
    EXPECT_FALSE(bench.order(midi::STOP));  // 003 §VII 17h: it can interrupt 13h, 14h and 15h
    EXPECT_EQ(bench->waiting_segments(), 3);
    bench.pass(milliseconds{512});
    EXPECT_EQ(bench->position(), 1'000);
    EXPECT_TRUE(bench.order(midi::SEGMENT, -500, 0x1000));
    bench.pass(milliseconds{3 * 512});
    EXPECT_EQ(bench->position(), 4'000);
    bench.pass(milliseconds{255});
    EXPECT_TRUE(bench->moving());
    bench.pass(milliseconds{1});
    EXPECT_FALSE(bench->moving());
    EXPECT_EQ(bench->position(), 3'500);
}

// 000 §VI 1Eh, the example: motor 01 waits exactly as long as 00 moves.
TEST(MidiSegments, APauseLastsAsLongAsItsTwin) {
    MidiBench moves;
    MidiBench waits;
    EXPECT_TRUE(moves.order(midi::SEGMENT, 1'000, 0x1000));
    EXPECT_TRUE(waits.order(midi::PAUSE, 1'000, 0x1000));
    for (MidiBench* bench : {&moves, &waits}) EXPECT_TRUE(bench->order(midi::SEGMENT, 10, 8'000));
    for (MidiBench* bench : {&moves, &waits})
        bench->pass(milliseconds{513});  // and the first of the next, 1 ms each
    EXPECT_EQ(moves->position(), 1'001);
    EXPECT_EQ(waits->position(), 1);
    EXPECT_TRUE(moves.order(midi::EMERGENCY_STOP));
    moves.pass(seconds{1});
    EXPECT_EQ(moves->position(), 1'001);
}

// 003 §IV, "busy", and 000 §VI 0Eh: 5 x 200 us an increment.
TEST(MidiBusy, AHeldShaftCatchesUpAtUnstallSpeed) {
    MidiBench bench;
    ASSERT_TRUE(bench.order(midi::TOLERANCE, 10));
    bench->hold_shaft(true);
    ASSERT_TRUE(bench.order(midi::GO_TO, 100));
    bench.pass(seconds{5});
    EXPECT_EQ(bench->position(), 0);
    EXPECT_TRUE(bench->busy());
    EXPECT_TRUE(bench->leds().catching_up);
    EXPECT_EQ(bench.ask(midi::GET_MEASURES) & midi::kNotBusy, 0U);
    EXPECT_FALSE(bench.order(midi::GO_TO, 5));
    bench->hold_shaft(false);
    bench.pass(milliseconds{91});
    EXPECT_FALSE(bench->busy());  // within 90..110
    EXPECT_GE(bench->position(), 90);
    EXPECT_LT(bench->position(), 93);
    bench.pass(milliseconds{20});
    EXPECT_EQ(bench->position(), 100);  // goes on to the exact place
    bench->turn_shaft(-50);
    EXPECT_TRUE(bench->busy());
    EXPECT_TRUE(bench.order(midi::EMERGENCY_STOP));  // ends the loop
    EXPECT_FALSE(bench->busy());
    bench.pass(seconds{1});
    EXPECT_EQ(bench->position(), 50);
}

TEST(MidiBusy, ALoadAboveTheTorqueStallsARun) {
    MidiBench bench;
    bench->set_load(0x20);
    ASSERT_TRUE(bench.order(midi::TORQUE, 0x20));
    ASSERT_TRUE(bench.order(midi::RUN, 0, 480));
    bench.pass(seconds{1});
    EXPECT_EQ(bench->position(), 0);
    EXPECT_TRUE(bench->busy());
    ASSERT_TRUE(bench.order(midi::TORQUE, 0x21));
    bench.pass(seconds{1});
    EXPECT_FALSE(bench->busy());
    EXPECT_NEAR(bench->position(), 16'667, 1);  // 8 MHz / 480 a second; the speed, not the place, is held
}

// 003 §IV: 18h ends it; 17h does not.
TEST(MidiBusy, AStopWithRampDoesNotEndTheCatchingUp) {
    MidiBench bench;
    bench->hold_shaft(true);
    ASSERT_TRUE(bench.order(midi::GO_TO, 100));
    bench.pass(seconds{1});
    EXPECT_TRUE(bench.order(midi::STOP));
    bench->hold_shaft(false);
    bench.run_out();
    EXPECT_EQ(bench->position(), 100);
}

// 003 §IV: -1073741824 to 1073741823.
TEST(MidiMotion, ThePositionWrapsAtThirtyOneBits) {
    MidiBench bench;
    bench->turn_shaft(midi::kMaxPosition);
    ASSERT_TRUE(bench.order(midi::SEGMENT, 3, 480));
    bench.run_out();
    EXPECT_EQ(bench->position(), midi::kMinPosition + 2);
    ASSERT_TRUE(bench.order(midi::SEGMENT, -3, 480));
    bench.run_out();
    EXPECT_EQ(bench->position(), midi::kMaxPosition);
}

}  // namespace
}  // namespace nplc::sim
