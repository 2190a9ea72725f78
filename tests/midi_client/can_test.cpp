#include <gtest/gtest.h>

#include "bus_can.h"
#include "midi_client/can_link.h"
#include "midi_client/master.h"

namespace nplc::midi_client {
namespace {

namespace midi = registers::midi;

class CanTest : public testing::Test {
  protected:
    BusCan can{{1, 2}};
    CanLink link{can};
    Master master{link, 3};
};

TEST_F(CanTest, FramesOfTheManual) {
    can.modules[0].set_supply(48'000);
    // 003 §VII 08h: Imax; §V.7.
    EXPECT_EQ(master.query(1, midi::GET_RAM, 0xAF) >> 24, 0x80u);
    EXPECT_EQ(can.sent.back(),
              (ports::CanFrame{.id = 0x601, .length = 8, .data = {0x40, 0x08, 0x20, 0xAF, 0, 0, 0, 0}}));
    EXPECT_EQ(link.last_sent(), "601#400820AF00000000");
    // 003 §VII 1Eh: 03E8h steps at 1000h.
    master.command(2, midi::PAUSE, 0x03E81000);
    EXPECT_EQ(
        can.sent.back(),
        (ports::CanFrame{.id = 0x602, .length = 8, .data = {0x23, 0x1E, 0x20, 0, 0x03, 0xE8, 0x10, 0x00}}));
    EXPECT_EQ(link.last_heard(), "582#601E200000000000");
    EXPECT_THROW(master.command(1, midi::BAUD, 1), Refused) << "on V24 only";
}

TEST_F(CanTest, ALostAnswerIsDoubtAndALostQueryIsAskedAgain) {
    unsigned lost = 0;
    can.loses = [&](std::size_t, const BusCan::Frame& frame) { return frame.id == 0x601 && lost++ < 1; };
    EXPECT_EQ(master.position(1), 0);
    EXPECT_EQ(can.sent.size(), 2u);
    lost = 0;
    EXPECT_THROW(master.command(1, midi::ZERO_POSITION), Unconfirmed);
    EXPECT_EQ(can.sent.size(), 3u);
}

TEST_F(CanTest, TheAddressIsProgrammed) {
    BusCan one({1});
    CanLink own(one);
    EXPECT_EQ(own.program_address(9), CanLink::Programmed::done);
    EXPECT_EQ(one.modules[0].memory().address, 9);
    // 003 §V.5, and nothing more.
    const std::vector<ports::CanFrame> expected{{.id = 0x7E5, .length = 8, .data = {0x04, 0x01}},
                                                {.id = 0x7E5, .length = 8, .data = {0x11, 0x09}},
                                                {.id = 0x7E5, .length = 8, .data = {0x04, 0x00}}};
    EXPECT_EQ(one.sent, expected);
    EXPECT_EQ(own.program_address(0), CanLink::Programmed::refused);
    EXPECT_EQ(one.modules[0].memory().address, 9);
    BusCan nobody({});
    CanLink empty(nobody);
    EXPECT_EQ(empty.program_address(9), CanLink::Programmed::silence);
}

// 003 §V.5: one alone; with the last message both would have the same address.
TEST_F(CanTest, TwoModulesAreNotGivenOneAddress) {
    EXPECT_EQ(link.program_address(9), CanLink::Programmed::several);
    EXPECT_EQ(can.modules[0].memory().address, 1);
    EXPECT_EQ(can.modules[1].memory().address, 2);
    const ports::CanFrame operate{.id = 0x7E5, .length = 8, .data = {0x04, 0x00}};
    EXPECT_EQ(std::count(can.sent.begin(), can.sent.end(), operate), 0);
}

// No manual gives its start-up time; 000 §VI 00h has two seconds.
TEST_F(CanTest, ABootUpMayTakeItsTime) {
    BusCan one({1});
    CanLink own(one);
    base::Instant booted{};
    one.master_misses = [&](const BusCan::Frame& frame) {
        if (frame.id == 0x709 && booted == base::Instant{}) booted = one.now();
        return frame.id == 0x709;
    };
    one.on_step = [&] {
        if (booted == base::Instant{} || one.now() < booted + base::Milliseconds{2'000}) return;
        one.tell({.id = 0x709, .length = 1});
        one.on_step = {};
    };
    EXPECT_EQ(own.program_address(9), CanLink::Programmed::done);
}

TEST_F(CanTest, WhatIsNoAnswerIsReadOver) {
    for (const BusCan::Frame& other :
         {BusCan::Frame{.id = 0x582, .length = 8, .data = {0x42, 0, 0x20, 0, 0, 0, 0, 7}},
          BusCan::Frame{.id = 0x581, .length = 8, .data = {0x42, 1, 0x20, 0, 0, 0, 0, 7}},
          BusCan::Frame{.id = 0x581, .length = 8, .data = {0x42, 0, 0x20, 1, 0, 0, 0, 7}},
          BusCan::Frame{.id = 0x581, .length = 8, .data = {0x60, 0, 0x20, 0, 0, 0, 0, 7}},
          BusCan::Frame{.id = 0x581, .length = 7, .data = {0x42, 0, 0x20, 0, 0, 0, 7}},
          BusCan::Frame{.id = 0x601, .length = 8, .data = {0x40, 0, 0x20, 0, 0, 0, 0, 0}}}) {
        can.loses = [&](std::size_t, const BusCan::Frame& frame) {
            if (frame.id == 0x601) can.tell(other);
            return false;
        };
        CanLink fresh(can);  // at three requests in a row they would be a second module's answers
        EXPECT_EQ(Master(fresh, 3).position(1), 0);
    }
}

TEST_F(CanTest, BootUpsAreKeptByAddress) {
    EXPECT_EQ(master.position(1), 0);
    EXPECT_TRUE(link.take_boot(1));
    EXPECT_FALSE(link.take_boot(1));
    can.tell({.id = 0x702, .length = 1});
    EXPECT_FALSE(link.take_boot(1));
    EXPECT_TRUE(link.take_boot(2));
}

TEST_F(CanTest, ABusThatTakesNothing) {
    can.takes = false;
    can.state_now = ports::CanState::bus_off;
    try {
        master.position(1);
        FAIL();
    } catch (const LineError& error) {
        EXPECT_EQ(error.kind(), LineError::Kind::port_gone);
        EXPECT_NE(std::string(error.what()).find("went off the bus"), std::string::npos);
    }
}

}  // namespace
}  // namespace nplc::midi_client
