// The frames of 000 §VI on a line, in lines for people, whole and damaged.
#include "macreg/monitor.h"

#include <gtest/gtest.h>

namespace nplc::macreg {
namespace {

const std::string kDone = "\x06\x13\x1A";
/// 000 §VI, the worked example: 300 rpm of a MAC23.
const std::string kRun =
    "\x02"
    "01400150000000320AB"
    "\x03";
/// 20h to address 00: 2A0h + 2.
const std::string kAsk =
    "\x02"
    "01400200000000000A2"
    "\x03";
/// -1000: FFFFFC18h. 11 x 30h + 5 x 16h + 13h + 1 + 8 = 29Ah.
const std::string kPosition =
    "\x06\x13\x02"
    "011000FFFFFC189A"
    "\x03\x1A";

struct MidiMonitorTest : testing::Test {
    std::unique_ptr<Monitor> monitor = make_midi_monitor({.model = registers::midi::Model::mac23});
    base::Instant now{};

    void hear(const std::string& text, Side side = Side::both) {
        for (const char c : text) {
            monitor->receive(side, static_cast<std::uint8_t>(c), now);
            now += base::Microseconds(261);
        }
    }
    std::vector<std::string> lines() {
        std::vector<std::string> lines;
        for (const MonitorEvent& event : monitor->take()) {
            std::string line = line_of(event, event.at);
            lines.push_back(line.substr(line.find(" s  ") + 4));
        }
        return lines;
    }
    using Lines = std::vector<std::string>;
};

TEST_F(MidiMonitorTest, TheManualsExamplesInOneStreamAndInTwo) {
    for (const bool two : {false, true}) {
        const Side master = two ? Side::master : Side::both;
        const Side module = two ? Side::motor : Side::both;
        hear(kRun, master);
        hear(kDone, module);
        hear(kAsk, master);
        hear(kPosition, module);
        const auto events = monitor->take();
        ASSERT_EQ(events.size(), 2U);
        EXPECT_EQ(line_of(events[0], events[0].at),
                  "0.000 s  -> RUN to address 0: clockwise, period 300 rpm (10000 inc/s)   <- accepted");
        EXPECT_EQ(std::string(events[0].sent.begin(), events[0].sent.end()), kRun);
        EXPECT_EQ(std::string(events[0].received.begin(), events[0].received.end()), kDone);
        EXPECT_EQ(line_of(events[1], events[1].at),
                  "0.000 s  -> GET_POSITION to address 0   <- position -1000 inc (-0.5000 rev)");
        EXPECT_EQ(std::string(events[1].received.begin(), events[1].received.end()), kPosition);
        EXPECT_EQ(events[1].value, 0xFFFFFC18U);
    }
}

// A file without end must not be held until its end.
TEST_F(MidiMonitorTest, NoiseIsToldInPieces) {
    constexpr std::size_t kBytes = 1'000, kMostHeld = 64;
    for (const Side side : {Side::both, Side::master, Side::motor}) {
        std::size_t told = 0;
        for (std::size_t heard = 1; heard <= kBytes; ++heard) {
            hear("A", side);
            for (const MonitorEvent& event : monitor->take())
                told += event.sent.size() + event.received.size();
            ASSERT_LE(heard - told, kMostHeld);
        }
        monitor->finish();
        for (const MonitorEvent& event : monitor->take()) told += event.sent.size() + event.received.size();
        EXPECT_EQ(told, kBytes) << "no byte is lost";
    }
}

TEST_F(MidiMonitorTest, EveryOtherAnswer) {
    hear(kRun + "\x15");
    hear(kRun + "\x06\x13\x17");
    hear(kAsk + kDone);
    hear(kRun);
    now += base::Milliseconds(500);
    monitor->pass(now);
    EXPECT_EQ(
        lines(),
        (Lines{"-> RUN to address 0: clockwise, period 300 rpm (10000 inc/s)   <- not understood (Nack)",
               "-> RUN to address 0: clockwise, period 300 rpm (10000 inc/s)   <- refused",
               "-> GET_POSITION to address 0   <- a damaged answer",
               "-> RUN to address 0: clockwise, period 300 rpm (10000 inc/s)   <- no answer"}));
}

TEST_F(MidiMonitorTest, WhatIsNoFrameIsToldWithItsBytes) {
    hear("ab" + kRun + kDone);
    std::string damaged = kRun;
    damaged[19] = 'C';  // its sum
    hear(damaged + "\x15");
    hear(kRun.substr(0, 8), Side::master);
    hear(kAsk, Side::master);
    hear("\x06\x13", Side::motor);
    monitor->finish();
    EXPECT_EQ(
        lines(),
        (Lines{"!! no answer to anything: 61 62",
               "-> RUN to address 0: clockwise, period 300 rpm (10000 inc/s)   <- accepted",
               "-> a damaged request to address 0   <- not understood (Nack)  !! its sum is wrong, or a "
               "character is no hexadecimal digit",
               "!! no frame: 02 30 31 34 30 30 31 35",
               "-> GET_POSITION to address 0   <- a damaged answer"}));
}

TEST_F(MidiMonitorTest, NoByteIsLost) {
    for (int first = 0; first < 256; ++first) {
        const std::string strange = std::string(1, static_cast<char>(first)) + "\x02" + "014\x02\x03" + "0";
        hear(strange + kRun + kDone);
        monitor->finish();
        std::string told;
        for (const MonitorEvent& event : monitor->take()) {
            told.append(event.sent.begin(), event.sent.end());
            told.append(event.received.begin(), event.received.end());
        }
        EXPECT_EQ(told, strange + kRun + kDone) << first;
    }
}

}  // namespace
}  // namespace nplc::macreg
