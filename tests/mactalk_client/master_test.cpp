#include "mactalk_client/master.h"

#include <gtest/gtest.h>

#include <iostream>
#include <random>
#include <sstream>

#include "motor_unit.h"

namespace nplc::mactalk_client {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;

Bytes hex(const std::string& text) {
    std::istringstream stream(text);
    Bytes result;
    for (unsigned value = 0; stream >> std::hex >> value;) result.push_back(static_cast<std::uint8_t>(value));
    return result;
}

struct MasterTest : testing::Test {
    MotorUnit unit;
    SimWire wire{unit, 19'200, 1};
    Master master{wire};

    static constexpr std::uint8_t kAddress = 8;
};

// 002 §5.7: V_SOLL (5) := 600 (0258h) at address 8, and its read.
TEST_F(MasterTest, SendsTheQuickGuidesMessages) {
    master.write(kAddress, 5, 600, Width::word);
    EXPECT_EQ(wire.sent(), hex("52 52 52 08 F7 05 FA 02 FD 58 A7 02 FD AA AA"));
    EXPECT_EQ(master.read(kAddress, 5) & 0xFFFF, 600U);
    EXPECT_EQ(Bytes(wire.sent().begin() + 15, wire.sent().end()), hex("50 50 50 08 F7 05 FA AA AA"));
    EXPECT_EQ(master.counters().timeouts, 0U);
    EXPECT_EQ(master.counters().stray_bytes, 0U);
}

// 001 §3.1: a longword written to a 16-bit register reaches the next one; a word does not.
TEST_F(MasterTest, WritesTheWidthItIsTold) {
    master.write(kAddress, 6, 7, Width::word);
    master.write(kAddress, 5, 600, Width::word);
    EXPECT_EQ(unit.motor.read(6), 7);
    master.write(kAddress, 5, 600, Width::longword);
    EXPECT_EQ(unit.motor.read(6), 0);
    master.write(kAddress, 3, 230'000, Width::longword);
    EXPECT_EQ(unit.motor.read(3), 230'000);
}

TEST_F(MasterTest, ReadsBlocks) {
    for (std::uint8_t reg = 100; reg < 132; ++reg) unit.motor.write(reg, 1000 + reg, false);
    const auto block = master.read_block(kAddress, 100);
    for (std::size_t i = 0; i < 32; ++i) {
        EXPECT_EQ(block[2 * i] | block[2 * i + 1] << 8,
                  static_cast<int>(unit.motor.read(static_cast<std::uint8_t>(100 + i)) & 0xFFFF))
            << i;
    }
}

// 001 §5.1: 54h takes a motor in INIT to SAFE, 56h writes the flash in SAFE, 57h resets; 55h leads back.
TEST_F(MasterTest, SendsTheMessagesWithoutARegister) {
    master.safe_mode(kAddress);
    master.init_mode(kAddress);
    EXPECT_EQ(wire.sent(), hex("54 54 54 08 F7 AA AA 55 55 55 08 F7 AA AA"));
    master.safe_mode(kAddress);
    const auto before = unit.motor.flash_writes();
    master.write_flash(kAddress);
    master.pause(100ms);
    EXPECT_EQ(unit.motor.flash_writes(), before + 1);
    master.reset(kAddress);
    master.pause(100ms);
    EXPECT_EQ(Bytes(wire.sent().end() - 7, wire.sent().end()), hex("57 57 57 08 F7 AA AA"));
}

TEST_F(MasterTest, ASampleIsAskedForOnce) {
    EXPECT_EQ(master.read_sample(kAddress, 8).size(), 8U);
    wire.from_unit().cut();
    const auto questions = master.counters().questions;
    EXPECT_THROW(master.read_sample(kAddress, 8), LineError);
    EXPECT_EQ(master.counters().questions, questions + 1);
}

TEST_F(MasterTest, SaysWhoDoesNotAnswer) {
    try {
        master.read(77, 5);
        FAIL();
    } catch (const LineError& error) {
        EXPECT_EQ(error.kind(), LineError::Kind::no_answer);
        EXPECT_STREQ(
            error.what(),
            "sim:line: no answer from address 77, asked 4 times; nothing came: is it switched on, and "
            "are address and speed right?");
    }
    EXPECT_EQ(master.counters().questions, 4U);
}

TEST_F(MasterTest, WhatNoMessageCanSayIsNotSent) {
    const Bytes odd(6);
    EXPECT_THROW(master.read(kAddress, 0), LineError);
    EXPECT_THROW(master.write(kAddress, 0, 1, Width::word), LineError);
    EXPECT_THROW(master.try_write_long(kAddress, 61, odd), LineError);
    EXPECT_TRUE(wire.sent().empty());
}

// A late accept of the first write must not be taken for the second one's, which is lost.
TEST_F(MasterTest, ALateAcceptCountsForNoOtherWrite) {
    unit.delay = 160ms;  // patience is 150 ms and the time on the line: 18 characters, 9 ms
    EXPECT_FALSE(master.try_write(kAddress, 5, 600, Width::word, -50ms));
    unit.delay = 0ms;
    wire.to_unit().cut();
    EXPECT_FALSE(master.try_write(kAddress, 6, 7, Width::word));
    wire.to_unit().restore();
    EXPECT_TRUE(master.try_write(kAddress, 6, 8, Width::word));
    EXPECT_EQ(unit.motor.read(5), 600);
    EXPECT_EQ(unit.motor.read(6), 8);
}

TEST_F(MasterTest, TryWriteSendsOnce) {
    wire.from_unit().cut();
    EXPECT_FALSE(master.try_write(kAddress, 5, 600, Width::word));
    EXPECT_EQ(wire.sent().size(), 15U);
    EXPECT_EQ(unit.motor.read(5), 600) << "done, the accept lost";
}

struct Noise : testing::TestWithParam<std::uint64_t> {};

TEST_P(Noise, NoWrongValueAndInStepAgainWithTheNextMessage) {
    const std::uint64_t seed = GetParam();
    MotorUnit unit;
    SimWire wire(unit, 19'200, seed);
    Master master(wire, {.attempts = 50});
    std::mt19937_64 random(seed);
    wire.set_faults({.drop = 0.01, .damage = 0.02, .framing = 0.01});
    for (int i = 0; i < 100; ++i) {
        const auto value = static_cast<std::uint16_t>(random());
        master.write(8, 5, value, Width::word);
        ASSERT_EQ(unit.motor.read(5) & 0xFFFF, value) << "seed " << seed << ", write " << i;
        ASSERT_EQ(master.read(8, 5) & 0xFFFF, value) << "seed " << seed << ", read " << i;
    }
    const auto bad = master.counters();
    EXPECT_GT(bad.timeouts, 0U);
    wire.set_faults({});
    master.pause(100ms);
    master.read(8, 5);
    EXPECT_EQ(master.counters().questions, bad.questions + 1) << "seed " << seed;
    std::cout << "seed " << seed << ": " << bad.questions << " questions for 200, " << bad.stray_bytes
              << " stray bytes\n";
}

INSTANTIATE_TEST_SUITE_P(Seeds, Noise, testing::Range<std::uint64_t>(1, 11));

}  // namespace
}  // namespace nplc::mactalk_client
