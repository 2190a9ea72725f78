#include "midi_client/master.h"

#include <gtest/gtest.h>

#include "midi_client/v24_link.h"
#include "scripted_wire.h"

namespace nplc::midi_client {
namespace {

namespace midi = registers::midi;
using Bytes = std::vector<std::uint8_t>;

// 000 §II.2, §III.2.
const Bytes kDone{0x06, 0x13, 0x1A};
const Bytes kRefused{0x06, 0x13, 0x17};
const Bytes kNack{0x15};
// 000 §VI, the worked example: 300 rpm clockwise on a MAC23 at address 00.
const Bytes kExample{0x02, 0x30, 0x31, 0x34, 0x30, 0x30, 0x31, 0x35, 0x30, 0x30, 0x30,
                     0x30, 0x30, 0x30, 0x30, 0x33, 0x32, 0x30, 0x41, 0x42, 0x03};

Bytes framed(const std::string& length, const std::string& fields) {
    unsigned sum = 0;
    for (const char c : fields) sum += static_cast<unsigned char>(c);
    const std::string digits = "0123456789ABCDEF";
    std::string text = "\x02" + length + fields + digits[sum >> 4 & 15] + digits[sum & 15] + "\x03";
    return {text.begin(), text.end()};
}
Bytes value(const std::string& fields) {
    Bytes bytes{0x06, 0x13};
    for (const std::uint8_t byte : framed("011", fields)) bytes.push_back(byte);
    bytes.push_back(0x1A);
    return bytes;
}

class MasterTest : public testing::Test {
  protected:
    ScriptedWire wire;
    V24Link link{wire};
    Master master{link, 4};
};

TEST_F(MasterTest, TheManualsExample) {
    wire.script = {{kDone}};
    master.command(0, midi::RUN, 0x0320);
    ASSERT_EQ(wire.sent.size(), 1u);
    EXPECT_EQ(wire.sent[0], kExample);
    EXPECT_EQ(link.last_sent(), "02 30 31 34 30 30 31 35 30 30 30 30 30 30 30 33 32 30 41 42 03");
    EXPECT_EQ(link.last_heard(), "06 13 1A");
}

TEST_F(MasterTest, QueriesHaveIndices20hAndUp) {
    wire.script = {{value("050FFFFFC18")}, {value("05880123456")}};
    EXPECT_EQ(master.position(5), -1000);
    EXPECT_EQ(wire.sent[0], framed("014", "05200000000000"));
    // 000 §VI 28h: Imax is at RAM AFh.
    EXPECT_EQ(master.query(5, midi::GET_RAM, 0xAF) >> 24, 0x80u);
    EXPECT_EQ(wire.sent[1], framed("014", "0528AF00000000"));
}

TEST_F(MasterTest, WhatWasNotUnderstoodIsSentAgain) {
    wire.script = {{kNack}, {kNack}, {kDone}};
    master.command(0, midi::RUN, 0x0320);
    EXPECT_EQ(wire.sent, std::vector<Bytes>(3, kExample));
    wire.script = {{kNack}, {kNack}, {kNack}, {kNack}, {kDone}};
    EXPECT_THROW(master.command(0, midi::RUN, 0x0320), LineError);
    EXPECT_EQ(wire.sent.size(), 7u);
    wire.script = {{kNack}, {kNack}, {kNack}, {kNack}};
    try {
        master.position(0);
        FAIL();
    } catch (const LineError& error) {
        EXPECT_NE(std::string(error.what()).find("address 0 says that GET_POSITION came damaged, 4 times"),
                  std::string::npos)
            << error.what();
    }
}

TEST_F(MasterTest, ARefusalIsOne) {
    wire.script = {{kRefused}, {{0x06, 0x13, 0x18}}};
    for (const bool by_18h : {false, true}) {
        try {
            master.command(0, midi::GO_TO, 5);
            FAIL();
        } catch (const Refused& error) {
            EXPECT_EQ(error.by_18h(), by_18h);
        }
    }
    EXPECT_EQ(wire.sent.size(), 2u);
}

TEST_F(MasterTest, ACommandWithoutAClearAnswerIsNotRepeated) {
    wire.script = {{value("00000000000")}, {}};
    EXPECT_EQ(master.position(0), 0);
    EXPECT_THROW(master.command(0, midi::SEGMENT, 0x03E81000), Unconfirmed);
    EXPECT_EQ(wire.sent.size(), 2u);
    wire.script = {{{0x06, 0x13, 0x55}}};
    EXPECT_THROW(master.command(0, midi::SEGMENT, 0x03E81000), Unconfirmed);
    EXPECT_EQ(wire.sent.size(), 3u);
}

TEST_F(MasterTest, AStopIsRepeatedUntilItIsConfirmed) {
    wire.script = {{}, {{0x06}}, {kNack}, {kDone}};
    EXPECT_TRUE(master.stop_hard(std::vector<std::uint8_t>{0}).empty());
    EXPECT_EQ(wire.sent.size(), 4u);
    EXPECT_EQ(master.stop_hard(std::vector<std::uint8_t>{7}), (std::vector<std::uint8_t>{7}));
}

TEST_F(MasterTest, ADamagedReplyIsAskedForAgain) {
    Bytes damaged = value("00000001234");
    damaged[10] ^= 1;
    wire.script = {{damaged}, {}, {value("00000001234")}};
    EXPECT_EQ(master.position(0), 0x1234);
    EXPECT_EQ(wire.sent.size(), 3u);
}

TEST_F(MasterTest, ALateAnswerIsNotTakenForTheNextOnes) {
    wire.script = {{kDone, base::Milliseconds{250}}, {kRefused}};
    EXPECT_THROW(master.command(0, midi::POWER_ON), LineError);
    EXPECT_THROW(master.command(0, midi::POWER_ON), Refused);
}

TEST_F(MasterTest, NobodyAnswers) {
    try {
        master.position(3);
        FAIL();
    } catch (const LineError& error) {
        EXPECT_EQ(error.kind(), LineError::Kind::no_answer);
        EXPECT_EQ(
            std::string(error.what()),
            "script:line: no answer from address 3, asked 4 times; is it switched on, and are address and "
            "speed right? `macreg midi find` asks all addresses");
    }
    wire.open = false;
    try {
        master.position(3);
        FAIL();
    } catch (const LineError& error) {
        EXPECT_EQ(error.kind(), LineError::Kind::port_gone);
    }
}

}  // namespace
}  // namespace nplc::midi_client
