// Modbus RTU on a microcontroller's user port: a line with other slaves, noise and a busy master.
#include <gtest/gtest.h>

#include "port_bench.h"
#include "protocol/modbus_rtu.h"
#include "registers/layout.h"

namespace nplc::gateway {
namespace {

using namespace std::chrono_literals;

constexpr std::uint8_t kUnit = reg::kDefaultAddress;
constexpr std::uint8_t kOther = kUnit + 1;
// Step 0: IN0 -> step 1. Step 1: IN1 -> step 0.
const Bytes kTwoSteps{{0xC0, 0x01, 0x01, 0x01, 0x80, 0x05, 0, 0}, {0xC1, 0x02, 0x02, 0x00, 0x80, 0x00, 0, 0}};

using Frame = std::vector<std::uint8_t>;

/// With its CRC, bit by bit (Serial Line V1.02 §2.5.1.2).
Frame frame(std::uint8_t unit, Frame pdu) {
    pdu.insert(pdu.begin(), unit);
    unsigned crc = 0xFFFF;
    for (const std::uint8_t byte : pdu) {
        crc ^= byte;
        for (int i = 0; i < 8; ++i) crc = (crc & 1) != 0 ? crc >> 1 ^ 0xA001U : crc >> 1;
    }
    pdu.push_back(static_cast<std::uint8_t>(crc));
    pdu.push_back(static_cast<std::uint8_t>(crc >> 8));
    return pdu;
}

Frame operator+(Frame one, const Frame& other) {
    one.insert(one.end(), other.begin(), other.end());
    return one;
}

const Frame kRunCoil{5, 0, 0, 0xFF, 0};
const Frame kReadStatus{4, 0, 1, 0, 1};

/// Every form in which masters write a stop, safe or hold.
const std::vector<Frame> kStops{
    {5, 0, 1, 0xFF, 0},
    {5, 0, 2, 0xFF, 0},
    {5, 0, 3, 0xFF, 0},
    {6, 0, 0, 0, 2},
    {6, 0, 0, 0, 3},
    {6, 0, 0, 0, 6},
    {15, 0, 0, 0, 4, 1, 0x02},
    {15, 0, 1, 0, 3, 1, 0x04},
    {16, 0, 0, 0, 1, 2, 0, 2},
    {16, 0, 0, 0, 2, 4, 0, 3, 0, 9},
    {16, 0, 0, 0, 3, 6, 0, 2, 0, 9, 0, 0},
    {16, 0, 0, 0, 4, 8, 0, 2, 0, 9, 0, 0, 0, 0},
};

struct ModbusUserPort : testing::Test, PortBench {
    ModbusUserPort() { EXPECT_TRUE(upload_and_activate(kTwoSteps)); }

    void start() {
        ASSERT_TRUE(command(reg::Command::run));
        run(10ms);
        ASSERT_TRUE(runs());
        line.sent.clear();
    }
    bool runs() const { return gateway->run_state() == reg::RunState::running; }
    /// At 19200 baud: the poll is faster than a character, and then nothing comes for `after`.
    void feed(const Frame& bytes, base::Microseconds after = 0ms) {
        for (const std::uint8_t byte : bytes) {
            line.received.push_back({byte, false});
            run(500us);
        }
        if (after != 0ms) run(after);
    }
    Frame answer(const Frame& request, base::Microseconds within = 50ms) {
        line.sent.clear();
        feed(request, within);
        return std::exchange(line.sent, {});
    }
    /// Frames of other slaves and their answers without a pause.
    Frame busy_line() const {
        Frame all;
        for (int i = 0; i < 8; ++i)
            all = all + frame(kOther, {3, 0, 0, 0, 2}) + frame(kOther, {3, 4, 1, 2, 3, 4});
        return all;
    }
};

TEST_F(ModbusUserPort, AStopIsTakenWhateverIsAroundIt) {
    const std::vector<Frame> before{
        {0x55},
        Frame(300, 0xA5),
        {kUnit, 5, 0},
        {kUnit, 16, 0, 0, 0, 20, 40},
        frame(kOther, {23, 0, 0, 0, 2, 0, 0, 0, 1, 2, 0, 1}),
        frame(kUnit, {43, 14, 1, 0}),
        frame(kUnit, kRunCoil) + Frame{0},
    };
    for (const Frame& stop : kStops) {
        for (const Frame& noise : before) {
            start();
            feed(noise + frame(kUnit, stop) + busy_line());
            EXPECT_FALSE(runs()) << int{stop[0]} << " behind " << noise.size();
            run(50ms);
            start();
            EXPECT_EQ(answer(frame(kUnit, stop)).size(), 8U) << "and alone it is answered";
            ASSERT_TRUE(command(reg::Command::stop));
        }
    }
}

TEST_F(ModbusUserPort, AStopBehindADamagedCharacterIsTaken) {
    start();
    line.received.push_back({0, true});
    feed(frame(kUnit, kStops[0]) + busy_line());
    EXPECT_FALSE(runs());
}

TEST_F(ModbusUserPort, ABroadcastStopsAndIsNotAnswered) {
    for (const Frame& stop : kStops) {
        start();
        EXPECT_TRUE(answer(frame(0, stop)).empty());
        EXPECT_FALSE(runs()) << int{stop[0]};
        ASSERT_TRUE(command(reg::Command::stop));
    }
    feed(frame(0, {5, 0, 0, 0, 0}), 5ms);
    EXPECT_TRUE(answer(frame(0, kRunCoil)).empty());
    feed(frame(0, {16, 0, 0, 0, 2, 4, 0, 0, 0, 0}), 5ms);
    EXPECT_TRUE(answer(frame(0, {16, 0, 0, 0, 2, 4, 0, 1, 0, 5})).empty());
    EXPECT_FALSE(runs()) << "nothing else is for all";
}

TEST_F(ModbusUserPort, ABroadcastLeavesTheHandshakeAlone) {
    ASSERT_EQ(answer(frame(kUnit, {16, 0, 0, 0, 2, 4, 0, 0, 0, 0})), frame(kUnit, {16, 0, 0, 0, 2}));
    ASSERT_EQ(answer(frame(kUnit, {16, 0, 0, 0, 2, 4, 0, 99, 0, 7})), frame(kUnit, {16, 0, 0, 0, 2}));
    const Frame read{4, 0, 41, 0, 2};
    const Frame bad_value = frame(kUnit, {4, 4, 0, 7, 0, 4});
    ASSERT_EQ(answer(frame(kUnit, read)), bad_value);
    EXPECT_TRUE(answer(frame(0, {16, 0, 0, 0, 2, 4, 0, 2, 0, 8})).empty());
    EXPECT_EQ(answer(frame(kUnit, read)), bad_value);
}

TEST_F(ModbusUserPort, WhatIsNoStopIsNotFound) {
    start();
    for (const Frame& stop : kStops) {
        Frame damaged = frame(kUnit, stop);
        damaged.back() ^= 1;
        EXPECT_TRUE(answer(damaged).empty());
        feed(Frame{0x55} + frame(kOther, stop), 5ms);
        EXPECT_TRUE(answer(frame(kOther, stop)).empty());
    }
    for (const Frame& other :
         std::vector<Frame>{{5, 0, 1, 0, 0}, {6, 0, 0, 0, 1}, {6, 0, 1, 0, 2}, {15, 0, 0, 0, 4, 1, 1}})
        feed(Frame{0x55} + frame(kUnit, other), 5ms);
    EXPECT_TRUE(runs());
}

TEST_F(ModbusUserPort, WhatIsNotWholeStartsNothing) {
    feed(frame(kUnit, {5, 0, 0, 0, 0}), 5ms);
    const Frame run_it = frame(kUnit, kRunCoil);
    for (std::size_t size = 1; size < run_it.size(); ++size)
        EXPECT_TRUE(
            answer(Frame(run_it.begin(), run_it.begin() + static_cast<std::ptrdiff_t>(size))).empty());
    EXPECT_TRUE(answer(Frame{0x55} + run_it).empty());
    // In a neighbour's answer.
    EXPECT_TRUE(answer(frame(kOther, Frame{3, 8} + run_it)).empty());
    EXPECT_FALSE(runs());
    EXPECT_EQ(answer(run_it), run_it) << "a pause is enough";
    EXPECT_TRUE(runs());
}

TEST_F(ModbusUserPort, WrongFunctionsAndLengthsAreExceptions) {
    EXPECT_EQ(answer(frame(kUnit, {7})), frame(kUnit, {0x87, 1}));
    EXPECT_EQ(answer(frame(kUnit, {23, 0, 0, 0, 1})), frame(kUnit, {0x97, 1}));
    EXPECT_EQ(answer(frame(kUnit, {5, 0, 0, 1, 0})), frame(kUnit, {0x85, 3}));
    EXPECT_EQ(answer(frame(kUnit, {6, 0, 0, 0, 1, 0})), frame(kUnit, {0x86, 3}));
    EXPECT_EQ(answer(frame(kUnit, {16, 0, 0, 0, 2, 2, 0, 1})), frame(kUnit, {0x90, 3}));
    EXPECT_EQ(answer(frame(kUnit, {4, 0, 0, 0, 0})), frame(kUnit, {0x84, 3}));
    EXPECT_EQ(answer(frame(kUnit, {4, 0xFF, 0xFF, 0, 2})), frame(kUnit, {0x84, 2}));
}

// A master that reads one word would put old and new halves together.
TEST_F(ModbusUserPort, HalfOfATwoWordValueIsRefused) {
    const Frame refused = frame(kUnit, {0x84, 2});
    EXPECT_EQ(answer(frame(kUnit, {4, 0, 18, 0, 1})), refused);
    EXPECT_EQ(answer(frame(kUnit, {4, 0, 19, 0, 1})), refused);
    EXPECT_EQ(answer(frame(kUnit, {4, 0, 19, 0, 2})), refused);
    EXPECT_EQ(answer(frame(kUnit, {4, 0, 14, 0, 5})), refused);
    EXPECT_EQ(answer(frame(kUnit, {4, 0, 48, 0, 1})), refused);
    EXPECT_EQ(answer(frame(kUnit, {4, 0, 20, 0, 2})).size(), 9U);
    EXPECT_EQ(answer(frame(kUnit, {4, 0, 41, 0, 2})).size(), 9U) << "two values of a word each";
    EXPECT_EQ(answer(frame(kUnit, {4, 0, 15, 0, 5})).size(), 15U);
}

TEST_F(ModbusUserPort, OfTwoRequestsWithoutAPauseBothAreCarriedOutAndTheLastAnswered) {
    start();
    const Frame said = answer(frame(kUnit, kStops[0]) + frame(kUnit, kReadStatus));
    EXPECT_FALSE(runs());
    ASSERT_EQ(said.size(), 7U);
    EXPECT_EQ(said[1], 4);
    EXPECT_NE(said[4] & 1U << 4, 0U) << "safe";
}

TEST_F(ModbusUserPort, AnEchoIsTheRequestsWhateverComesMeanwhile) {
    constexpr std::uint8_t kAt = (1000 + 2 * registers::V_SOLL) & 0xFF;
    constexpr std::uint8_t kHigh = (1000 + 2 * registers::V_SOLL) >> 8;
    board.access_answers = motor::AccessState::waiting;
    line.sent.clear();
    feed(frame(kUnit, {16, kHigh, kAt, 0, 2, 4, 0, 0, 0, 100}), 5ms);
    EXPECT_TRUE(line.sent.empty());
    feed({0x11, 0x22, 0x33, 0x44, 0x55, 0x66});
    board.access = motor::AccessState::done;
    run(20ms);
    EXPECT_EQ(line.sent, frame(kUnit, {16, kHigh, kAt, 0, 2}));
}

/// The master has given up: an answer now would meet the other slave's.
TEST_F(ModbusUserPort, AnAnswerDoesNotComeIntoTheNextSlavesTurn) {
    board.access_answers = motor::AccessState::waiting;
    feed(frame(kUnit, {4, 0, 100, 0, 2}), 5ms);
    feed(frame(kOther, kReadStatus));
    line.sent.clear();
    board.access = motor::AccessState::done;
    run(50ms);
    EXPECT_TRUE(line.sent.empty());
    EXPECT_EQ(answer(frame(kUnit, {4, 0, 0, 0, 1})), frame(kUnit, {4, 2, 0, 1}));
}

}  // namespace
}  // namespace nplc::gateway
