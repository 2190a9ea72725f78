// The driver on the CAN link, frame by frame (003 §V, §VII), with a module whose answers the test determines.

#include <algorithm>
#include <cstdio>
#include <random>

#include "midi_can_fixture.h"

namespace nplc::motor {
namespace {

/// The driver on this bus, and a module whose answers the test determines.
struct MidiCanScriptTest : MidiCanLineTest {
    MidiMotor driver{link, {.model = midi::Model::mac34_1}};
    std::string position = "00 00 00 00";
    std::string status = "00 00 00 00";
    bool busy = false;
    Frames commands;  ///< all that were sent

    /// The next frame that is sent, polled at the driver's own deadlines.
    std::string next() {
        for (int i = 0; i < 10'000; ++i) {
            driver.poll(now);
            if (!bus.sent.empty()) {
                EXPECT_EQ(bus.sent.size(), 1U);
                const std::string frame = bus.take().front();
                if (frame.substr(4, 2) == "23") commands.push_back(frame);
                return frame;
            }
            now = std::min(driver.next_poll(now), now + base::Microseconds(10'000));
        }
        return {};
    }
    void answer(const std::string& text) {
        hear(text);
        now += base::Microseconds(1'000);
    }
    void accept(const std::string& command) { answer("585 60 " + command.substr(7, 8) + " 00 00 00 00"); }
    void refuse(const std::string& command) { answer("585 80 " + command.substr(7, 8) + " 00 00 00 00"); }
    void answer_query(const std::string& frame) {
        const std::string number = frame.substr(7, 2);
        std::string data = "00 00 00 00";
        if (number == "00") data = position;
        if (number == "01") data = status;
        if (number == "05") data = "05 00 00 A0";  // 300 rpm
        if (number == "06") data = "10 80 10 00";
        if (number == "07") data = busy ? "50 78 00 00" : "50 78 08 00";
        if (number == "08") data = "80 00 00 00";
        answer("585 42 " + frame.substr(7, 8) + " " + data);
    }
    /// Answers queries until a command is sent, which is not answered yet.
    std::string until_command(int most = 400) {
        for (int i = 0; i < most; ++i) {
            const std::string frame = next();
            if (frame.empty() || frame.substr(4, 2) == "23") return frame;
            answer_query(frame);
        }
        return {};
    }
    void start() {
        EXPECT_EQ(until_command(), "");
        ASSERT_EQ(driver.link(), Link::up);
        EXPECT_TRUE(driver.orders_complete());
    }
    /// To one revolution at 600 rpm: 50h a period, 2710h increments.
    void order_move() {
        driver.send(word(registers::V_SOLL, 1'258));  // 100663.296 / 1258 = 80.02
        driver.send(longword(registers::P_SOLL, 4'096));
        driver.send(word(registers::MODE_REG, 2));
    }
    void move() {
        order_move();
        const std::string speed = until_command();
        EXPECT_EQ(speed, "605 23 0D 20 00 00 00 00 50");
        accept(speed);
        EXPECT_EQ(until_command(), kGo);
    }
    /// Answers queries while the shaft turns on to there, step by step.
    void travel_to(unsigned increments) {
        for (unsigned i = 1; i <= 10; ++i) {
            const unsigned at = increments * i / 10;
            char bytes[20];
            std::snprintf(bytes, sizeof bytes, "00 00 %02X %02X", at >> 8, at & 0xFFU);
            position = bytes;
            EXPECT_EQ(until_command(4), "");
        }
    }
    void expect_one_error(MidiFault fault) {
        EXPECT_TRUE(driver.error());
        EXPECT_EQ(driver.fault(), fault) << text_of(driver.fault());
        EXPECT_FALSE(driver.in_position());
    }
    std::size_t count(const std::string& command) const {
        return static_cast<std::size_t>(std::count(commands.begin(), commands.end(), command));
    }

    const std::string kGo = "605 23 13 20 00 00 00 27 10";
    const std::string kStop = "605 23 17 20 00 00 00 00 00";
    const std::string kHardStop = "605 23 18 20 00 00 00 00 00";
    const std::string kReset = "605 23 00 20 00 00 00 00 00";
};

TEST_F(MidiCanScriptTest, StartsByAskingWhatTheModuleHas) {
    for (const char* wanted :
         {"605 40 01 20 00 00 00 00 00", "605 40 08 20 AF 00 00 00 00", "605 40 05 20 00 00 00 00 00",
          "605 40 06 20 00 00 00 00 00", "605 40 00 20 00 00 00 00 00"}) {
        EXPECT_NE(driver.link(), Link::up);
        const std::string frame = next();
        EXPECT_EQ(frame, wanted);
        answer_query(frame);
    }
    driver.poll(now);
    EXPECT_EQ(driver.link(), Link::up);
}

TEST_F(MidiCanScriptTest, AMoveFromASequence) {
    start();
    move();
    accept(kGo);
    busy = true;
    EXPECT_EQ(until_command(40), "");
    EXPECT_FALSE(driver.in_position());
    travel_to(10'000);
    busy = false;
    EXPECT_EQ(until_command(40), "");
    EXPECT_TRUE(driver.in_position());
    EXPECT_FALSE(driver.error());
    EXPECT_EQ(commands.size(), 2U);
}

// 100663.296 / 32768 = 3.07; no value of a register may be taken for "never written".
TEST_F(MidiCanScriptTest, TheFastestSpeedToTheLeft) {
    start();
    driver.send(word(registers::V_SOLL, -32'768));
    driver.send(word(registers::MODE_REG, 1));
    EXPECT_EQ(until_command(), "605 23 15 20 00 00 F6 00 03");
}

TEST_F(MidiCanScriptTest, ARefusedMoveIsTriedAgainAndThenOneError) {
    start();
    order_move();
    int times = 0;
    for (std::string frame = until_command(); !frame.empty() && times < 200; frame = until_command()) {
        EXPECT_TRUE(frame == kGo || frame == kHardStop || frame.substr(7, 2) == "0D") << frame;
        times += frame == kGo ? 1 : 0;
        frame == kGo ? refuse(frame) : accept(frame);
    }
    EXPECT_EQ(times, 51);
    expect_one_error(MidiFault::refused);
    EXPECT_EQ(until_command(), "") << "and no more of it";
}

TEST_F(MidiCanScriptTest, AMoveOfWhichNobodyKnowsIsAskedAfterFirst) {
    start();
    move();
    EXPECT_EQ(next(), kAskStatus) << "after silence a query";
    answer("585 60 13 20 00 00 00 00 00");  // late, and for no request
    answer_query(kAskStatus);
    busy = true;  // it was taken
    EXPECT_EQ(until_command(40), "");
    travel_to(10'000);
    busy = false;
    EXPECT_EQ(until_command(40), "");
    EXPECT_TRUE(driver.in_position());
    EXPECT_EQ(count(kGo), 1U);
    EXPECT_EQ(driver.counters().resent, 0U);
}

TEST_F(MidiCanScriptTest, AndIsSentAgainWhenTheShaftStandsElsewhereButNotForEver) {
    start();
    move();
    for (int i = 0; i < 3; ++i) EXPECT_EQ(until_command(), kGo);
    std::string frame = until_command();
    EXPECT_TRUE(frame == kStop || frame == kHardStop) << frame;
    accept(frame);
    EXPECT_EQ(until_command(), "");
    EXPECT_EQ(count(kGo), 4U);
    expect_one_error(MidiFault::unclear);
}

TEST_F(MidiCanScriptTest, AnswersOfAnotherNodeAreSilence) {
    start();
    move();
    const base::Instant begun = now;
    while (driver.link() == Link::up && now - begun < 5s) {
        std::string frame = next();
        answer("586 " + std::string(frame.substr(4, 2) == "23" ? "60" : "42") + frame.substr(6));
    }
    EXPECT_LT(now - begun, 500ms);
    expect_one_error(MidiFault::link_lost);
    EXPECT_EQ(count(kGo), 1U);
}

TEST_F(MidiCanScriptTest, ABootUpBetweenTheTwoFramesOfAMove) {
    start();
    order_move();
    const std::string speed = until_command();
    accept(speed);
    hear(kBoot);
    EXPECT_EQ(until_command(), "") << "neither the move nor anything else";
    expect_one_error(MidiFault::restarted);
    EXPECT_EQ(count(kGo), 0U);
    EXPECT_EQ(driver.link(), Link::unacknowledged);
    driver.send(fast(kResetError));
    EXPECT_EQ(until_command(), "") << "nor is it taken up again";
    EXPECT_FALSE(driver.error());
}

TEST_F(MidiCanScriptTest, ABootUpBeforeTheMovesAnswer) {
    start();
    move();
    hear(kBoot);
    accept(kGo);  // it took it, in the new life
    driver.poll(now);
    expect_one_error(MidiFault::restarted);
    driver.stop();  // as the gateway does after every loss
    EXPECT_EQ(until_command(), kStop);
    accept(kStop);
    EXPECT_EQ(until_command(), "");
    EXPECT_EQ(count(kGo), 1U);
}

TEST_F(MidiCanScriptTest, ABootUpWhileNobodyKnowsOfAMove) {
    start();
    move();
    EXPECT_EQ(next(), kAskStatus);
    hear(kBoot);
    EXPECT_EQ(until_command(), "");
    expect_one_error(MidiFault::restarted);
    EXPECT_EQ(count(kGo), 1U);
}

TEST_F(MidiCanScriptTest, APortThatTakesNothingIsALostLink) {
    start();
    bus.takes = false;
    order_move();
    const base::Instant begun = now;
    while (driver.link() == Link::up && now - begun < 5s) {
        driver.poll(now);
        now += base::Microseconds(1'000);
    }
    EXPECT_LT(now - begun, 400ms) << "three messages' time, as with a module that is silent";
    expect_one_error(MidiFault::link_lost);
    bus.takes = true;
    EXPECT_EQ(until_command(), "") << "not delivered late";
}

TEST_F(MidiCanScriptTest, AStopOvertakesAMoveThatWaitsForThePort) {
    start();
    order_move();
    const std::string speed = until_command();
    bus.takes = false;
    accept(speed);
    driver.poll(now);
    driver.stop();
    bus.takes = true;
    EXPECT_EQ(until_command(), kStop);
    EXPECT_EQ(count(kGo), 0U);
}

TEST_F(MidiCanScriptTest, ABusThatGoesDownIsALostLinkAtOnce) {
    start();
    move();  // its answer is waited for
    bus.state_now = ports::CanState::down;
    driver.poll(now);
    EXPECT_EQ(driver.link(), Link::down);
    expect_one_error(MidiFault::link_lost);
    bus.state_now = ports::CanState::active;
    EXPECT_EQ(until_command(), "") << "not delivered late";
}

TEST_F(MidiCanScriptTest, BusOffInMidMove) {
    start();
    move();
    accept(kGo);
    driver.poll(now);
    bus.take();
    bus.state_now = ports::CanState::bus_off;
    const base::Instant begun = now;
    while (now - begun < 1s) {
        driver.poll(now);
        now += base::Microseconds(1'000);
    }
    EXPECT_EQ(driver.link(), Link::down);
    expect_one_error(MidiFault::link_lost);
    EXPECT_GE(bus.restarts, 9U);
    EXPECT_LE(bus.restarts, 11U);
    EXPECT_EQ(bus.take(), Frames{});
}

TEST_F(MidiCanScriptTest, APositionToBeZeroedBehindARefusedStopIsNoReasonToPoll) {
    start();
    move();
    accept(kGo);
    driver.stop();
    EXPECT_EQ(until_command(), kStop);
    refuse(kStop);
    EXPECT_EQ(until_command(), kHardStop);
    refuse(kHardStop);
    driver.send(fast(0x63));  // P_IST := 0
    const base::Instant end = now + 40ms;
    int polls = 0;
    while (now < end) {
        driver.poll(now);
        ++polls;
        const Frames sent = bus.take();
        for (const std::string& frame : sent)
            frame.substr(4, 2) == "23" ? refuse(frame) : answer_query(frame);
        if (sent.empty()) now = std::max(driver.next_poll(now), now + base::Microseconds(1));
    }
    EXPECT_LT(polls, 200);
}

TEST_F(MidiCanScriptTest, ATrippedModuleThatRefusesStopsToo) {
    start();
    move();
    accept(kGo);
    status = "08 00 00 00";  // the amplifier
    driver.stop();
    EXPECT_EQ(until_command(), kStop);
    refuse(kStop);
    EXPECT_EQ(until_command(), kHardStop);
    refuse(kHardStop);
    EXPECT_FALSE(driver.stop_confirmed());
    for (int i = 0; i < 5 && until_command() == kHardStop; ++i) refuse(kHardStop);
    EXPECT_TRUE(driver.stop_confirmed()) << "its shaft was read at rest";
    EXPECT_TRUE(driver.error());
    EXPECT_TRUE(driver.orders_complete());
    driver.send(fast(kResetError));
    EXPECT_EQ(until_command(), kReset);
    accept(kReset);
    status = "00 00 00 00";
    driver.poll(now);
    hear(kBoot);
    EXPECT_EQ(until_command(), "");
    EXPECT_EQ(driver.link(), Link::up);
    EXPECT_FALSE(driver.error());
}

TEST_F(MidiCanScriptTest, WhatAnotherMasterPreparedForASyncIsForgotten) {
    start();
    move();
    accept(kGo);  // only prepared: another master had sent 10h
    EXPECT_EQ(until_command(), kHardStop) << "or any SYNC would start it, whenever";
    accept(kHardStop);
    EXPECT_EQ(until_command(), "");
    expect_one_error(MidiFault::not_arrived);
}

TEST_F(MidiCanScriptTest, AnotherMastersShortMoveAtRestIsNoticed) {
    start();
    move();
    accept(kGo);
    position = "00 00 27 10";
    EXPECT_EQ(until_command(40), "");
    ASSERT_TRUE(driver.in_position());
    position = "00 00 27 15";  // 5 increments: what standby may swing (003 §VII 02h)
    EXPECT_EQ(until_command(40), "");
    EXPECT_TRUE(driver.in_position());
    position = "00 00 28 10";  // done between two questions for "busy"
    static_cast<void>(until_command(100));
    expect_one_error(MidiFault::not_arrived);
}

// 003 §VII 02h: a shaft in standby may swing by 5 increments, and the factory's tolerance is 0.
TEST_F(MidiCanScriptTest, AShaftThatSwingsInStandbyArrives) {
    start();
    move();
    accept(kGo);
    for (const char* place : {"00 00 27 0D", "00 00 27 14", "00 00 27 0B"}) {
        position = place;
        EXPECT_EQ(until_command(30), "") << place;
        EXPECT_FALSE(driver.in_position()) << place;
    }
    position = "00 00 27 10";
    EXPECT_EQ(until_command(30), "");
    EXPECT_TRUE(driver.in_position());
    EXPECT_FALSE(driver.error());
}

TEST_F(MidiCanScriptTest, AndOneThatStandsBesideItsPlaceIsAnErrorInTheEnd) {
    start();
    move();
    accept(kGo);
    position = "00 00 27 0D";
    const base::Instant begun = now;
    EXPECT_EQ(until_command(), kHardStop);
    EXPECT_LT(now - begun, 1'200ms);
    accept(kHardStop);
    EXPECT_EQ(until_command(), "");
    expect_one_error(MidiFault::not_arrived);
}

// Frames of all kinds, most with a wrong part, at any time: bounded, and no motion sent that was not ordered.
TEST_F(MidiCanScriptTest, AnythingOnTheBus) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        std::mt19937 dice(seed);
        ScriptedCan any_bus;
        MidiCanLink any_link(any_bus, {.address = 5});
        MidiMotor any(any_link, {.model = midi::Model::mac34_1});
        std::size_t moves = 0;
        int orders = 0;
        for (int i = 0; i < 4'000; ++i) {
            now += base::Microseconds(dice() % 3'000);
            const Frames sent = any_bus.take();
            for (const std::string& frame : sent) moves += frame.starts_with("605 23 13") ? 1U : 0U;
            ports::CanFrame frame = can_frame("585 42 00 20 00 00 00 00 00");
            if (!sent.empty() && dice() % 4 != 0) {
                const ports::CanFrame asked = can_frame(sent.front());
                frame.data = asked.data;
                frame.data[0] = asked.data[0] == 0x23 ? 0x60 : 0x42;
            }
            for (unsigned byte = 4; byte < 8; ++byte) frame.data[byte] = static_cast<std::uint8_t>(dice());
            if (frame.data[2] == 1) frame.data[4] = 0;
            if (dice() % 8 == 0) frame.data[dice() % 8] = static_cast<std::uint8_t>(dice());
            if (dice() % 16 == 0) frame.length = static_cast<std::uint8_t>(dice() % 9);
            if (dice() % 16 == 0) frame.id = dice() % 0x800;
            if (dice() % 400 == 0) frame = can_frame(kBoot);
            any_bus.received.push_back(frame);
            any.poll(now);
            if (dice() % 50 != 0 || !any.has_room()) continue;
            any.send(fast(kResetError));
            any.send(word(registers::MODE_REG, 2));
            any.send(longword(registers::P_SOLL, 4'096 * ++orders));
            const bool reads = any.begin_access({.reg = registers::V_IST});
            EXPECT_TRUE(!reads || link_is_usable(any.link()));
        }
        // Each order at most once, and three times more if it was in doubt.
        EXPECT_LE(moves, 4U * static_cast<std::size_t>(orders));
        for (int i = 0; i < 5'000 && any.link() != Link::down; ++i) {
            now += base::Microseconds(1'000);
            any.poll(now);
        }
        EXPECT_EQ(any.link(), Link::down);
        EXPECT_TRUE(any.orders_complete());
    }
}

/// "P_IST = 0" (03h) sets the module's origin, 0Bh. Only the position shows whether it was accepted.
struct UnansweredOrigin : MidiCanScriptTest {
    const std::string kZero = "605 23 0B 20 00 00 00 00 00";

    /// The frames that follow, answered but for a command, until one has passed.
    void lose_the_answer() {
        start();
        position = "00 00 27 10";
        driver.send(fast(0x63));
        ASSERT_EQ(until_command(), kZero);
    }
};

TEST_F(UnansweredOrigin, IsNotSetAgainIfThePositionIs0) {
    lose_the_answer();
    position = "00 00 00 00";
    EXPECT_EQ(until_command(60), "");
    EXPECT_FALSE(driver.error());
    EXPECT_TRUE(driver.orders_complete());
    EXPECT_EQ(count(kZero), 1U);
}

TEST_F(UnansweredOrigin, IsSetAgainIfThePositionIsNot0) {
    lose_the_answer();
    EXPECT_EQ(until_command(60), kZero);
    accept(kZero);
    position = "00 00 00 00";
    EXPECT_EQ(until_command(60), "");
    EXPECT_FALSE(driver.error());
    EXPECT_TRUE(driver.orders_complete());
    EXPECT_EQ(count(kZero), 2U);
}

TEST_F(MidiCanScriptTest, AReleaseThatDoesNotKnowImaxIsUsedWithoutIt) {
    for (int i = 0; i < 20 && driver.link() != Link::up; ++i) {
        const std::string frame = next();
        frame.substr(7, 2) == "08" ? refuse(frame) : answer_query(frame);
    }
    EXPECT_EQ(driver.link(), Link::up);
    EXPECT_FALSE(driver.error());
    // T_SOLL 511 of 1023 is half of the 80h = 128 that full torque has then.
    driver.send(word(registers::T_SOLL, 512));
    EXPECT_EQ(until_command(), "605 23 0C 20 00 00 00 00 40");
}

TEST_F(MidiCanScriptTest, ARefusedToleranceIsOneErrorAndNotTriedForEver) {
    start();
    driver.send(word(registers::INPOSWIN, 41));  // of 4096 a turn: 100 of 10000
    const std::string tolerance = until_command();
    EXPECT_EQ(tolerance.substr(0, 9), "605 23 1C");
    refuse(tolerance);
    EXPECT_EQ(until_command(60), "");
    expect_one_error(MidiFault::refused);
    EXPECT_EQ(commands.size(), 1U);
}

TEST_F(MidiCanScriptTest, ARegisterThatWasNeverWrittenReadsWhatTheModuleHas) {
    start();
    ASSERT_TRUE(driver.begin_access({.reg = registers::V_SOLL}));
    for (int i = 0; i < 20 && is_open(driver.access_state()); ++i) answer_query(next());
    EXPECT_EQ(driver.access_state(), AccessState::done);
    EXPECT_EQ(driver.access_value(), 629U) << "A0h, 300 rpm: 100663.296 / 160";
}

}  // namespace
}  // namespace nplc::motor
