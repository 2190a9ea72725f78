// Bytes of 001 §5.1 and §5.2 in lines for people, whole and damaged.
#include "macreg/monitor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "protocol/flexmac.h"
#include "protocol/mactalk.h"

namespace nplc::macreg {
namespace {

namespace mactalk = protocol::mactalk;
using base::Instant;
using base::Microseconds;
using Bytes = std::vector<std::uint8_t>;

Bytes from_hex(const std::string& text) {
    Bytes bytes;
    for (std::size_t i = 0; i < text.size(); i += 3)
        bytes.push_back(static_cast<std::uint8_t>(std::stoi(text.substr(i, 2), nullptr, 16)));
    return bytes;
}

/// A byte a millisecond; the lines that came of it.
class Listener {
  public:
    explicit Listener(std::unique_ptr<Monitor> monitor) : monitor_(std::move(monitor)) {}

    void hear(const Bytes& bytes, Side side = Side::both) {
        for (const std::uint8_t byte : bytes) {
            monitor_->receive(side, byte, now_);
            now_ += step;
        }
    }
    void hear(const std::string& hex, Side side = Side::both) { hear(from_hex(hex), side); }
    void wait(Microseconds time) {
        now_ += time;
        monitor_->pass(now_);
    }
    void finish() { monitor_->finish(); }
    std::vector<std::string> lines() {
        std::vector<std::string> out;
        for (const MonitorEvent& event : events()) out.push_back(line_of(event, Instant{}));
        return out;
    }
    std::vector<MonitorEvent> events() { return monitor_->take(); }

    Microseconds step{1'000};

  private:
    std::unique_ptr<Monitor> monitor_;
    Instant now_{};
};

Listener mactalk_line(MonitorOptions options = {}) {
    return Listener(make_mactalk_monitor(options));
}
Listener fastmac_line(MonitorOptions options = {}) {
    return Listener(make_fastmac_monitor(options));
}

// 001 §5.1's messages; its read reply with the register block that units send.
const std::string kRead = "50 50 50 13 EC 07 F8 AA AA";
const std::string kReadReply = "52 52 52 00 FF 07 F8 04 FB 11 EE 47 B8 00 FF 00 FF AA AA";
const std::string kWrite = "52 52 52 10 EF 08 F7 02 FD 22 DD 33 CC AA AA";
const std::string kSafe = "54 54 54 17 E8 AA AA";
const std::string kAccept = "11 11 11";

std::string one(Listener& line) {
    const auto lines = line.lines();
    EXPECT_EQ(lines.size(), 1U) << (lines.empty() ? "none" : lines.front());
    return lines.empty() ? "" : lines.front();
}

TEST(MactalkMonitor, TheManualsMessages) {
    auto line = mactalk_line();
    line.hear(kRead);
    EXPECT_TRUE(line.lines().empty()) << "waits for the answer";
    line.hear(kReadReply);
    // 4711h = 18193 of 1023 = 1778.397 % of the peak torque.
    EXPECT_EQ(one(line), "0.000 s  -> motor 19: read T_SOLL (7)   <- 4711 = 1778.397 %peak");
    line.hear(kWrite);
    line.hear(kAccept);
    EXPECT_EQ(one(line), "0.028 s  -> motor 16: write P_FNC (8) := 3322   <- accepted");
    line.hear(kSafe);
    line.hear(kAccept);
    EXPECT_EQ(one(line), "0.046 s  -> motor 23: go to SAFE_MODE   <- accepted");
}

TEST(MactalkMonitor, APositionInCounts) {
    auto line = mactalk_line();
    line.hear("50 50 50 FE 01 0A F5 AA AA");
    line.hear("52 52 52 00 FF 0A F5 04 FB 34 CB 12 ED 00 FF 00 FF AA AA");  // 1234h = 4660
    EXPECT_EQ(one(line), "0.000 s  -> motor 254: read P_IST (10)   <- 00001234 = 4660 counts");
}

TEST(MactalkMonitor, BitsAndModesHaveNames) {
    auto line = mactalk_line();
    line.hear("50 50 50 01 FE 23 DC AA AA");
    line.hear("52 52 52 00 FF 23 DC 04 FB 12 ED 00 FF 00 FF 00 FF AA AA");  // bits 1 and 4
    EXPECT_EQ(one(line), "0.000 s  -> motor 1: read ERR_STAT (35)   <- 0012 = FLW_ERR IN_POS");
    line.hear("52 52 52 01 FE 02 FD 02 FD 02 FD 00 FF AA AA");
    line.hear(kAccept);
    EXPECT_EQ(one(line), "0.028 s  -> motor 1: write MODE_REG (2) := 0002 = P_MODE   <- accepted");
}

TEST(MactalkMonitor, WhatTakesNoAnswerIsToldAtOnce) {
    auto line = mactalk_line();
    line.hear("56 56 56 01 FE AA AA");
    EXPECT_EQ(one(line), "0.000 s  -> motor 1: write the parameters to flash, and reset");
    line.hear("57 57 57 FF 00 AA AA");
    EXPECT_EQ(one(line), "0.007 s  -> every motor: reset");
}

TEST(MactalkMonitor, SamplesAndBlocks) {
    auto line = mactalk_line();
    line.hear("53 53 53 01 FE AA AA");
    line.hear("52 52 52 00 FF 08 F7 01 FE 00 FF 02 FD 00 FF 03 FC 00 FF 04 FB 00 FF AA AA");
    EXPECT_EQ(one(line), "0.000 s  -> motor 1: read the next sample   <- sample 01 00 02 00 03 00 04 00");
    line.hear("51 51 51 01 FE 01 FE AA AA");
    const Bytes data(mactalk::kBlockBytes, 0);
    const auto reply = mactalk::encode_registers(1, data);
    line.hear(Bytes(reply.view().begin(), reply.view().end()));
    EXPECT_TRUE(one(line).starts_with(
        "0.032 s  -> motor 1: read PROG_VERSION (1) and what follows, 64 bytes   <- 00 00"));
}

// 001 §3.2: V_SOLL is one word, A_SOLL the next.
TEST(MactalkMonitor, FourBytesToAWordReachTheNextRegister) {
    auto line = mactalk_line();
    line.hear("52 52 52 01 FE 05 FA 04 FB 10 EF 00 FF 20 DF 00 FF AA AA");
    line.finish();
    const std::string told = one(line);
    EXPECT_NE(told.find("and A_SOLL (6) := 0020 (4 bytes to a 16-bit register)"), std::string::npos) << told;
    EXPECT_NE(told.find("<- no answer"), std::string::npos) << told;
}

TEST(MactalkMonitor, ARequestWithoutAnswer) {
    auto line = mactalk_line();
    line.hear(kRead);
    line.wait(Microseconds{900'000});
    EXPECT_TRUE(line.lines().empty());
    line.wait(Microseconds{200'000});
    EXPECT_EQ(one(line), "0.000 s  -> motor 19: read T_SOLL (7)   <- no answer");
    line.hear(kRead);
    line.hear(kSafe);
    EXPECT_EQ(line.lines().size(), 1U) << "the next request ends the wait";
}

TEST(MactalkMonitor, TheGatewaysRegistersHaveTheirNames) {
    auto line = mactalk_line({.gateway = 128});
    line.hear("50 50 50 80 7F 10 EF AA AA");
    line.finish();
    EXPECT_EQ(one(line), "0.000 s  -> gateway 128: read STATUS (16)   <- no answer");
}

TEST(MactalkMonitor, FlawsAreNamed) {
    auto line = mactalk_line();
    line.hear("50 50 50 13 EC 07 F9 AA AA");
    EXPECT_EQ(one(line),
              "0.000 s  !! byte 6 (register): 07 is followed by F9, its complement is F8: "
              "50 50 50 13 EC 07 F9 AA AA");
    line.hear("50 50 50 13 EC 07");
    line.hear(kSafe);
    EXPECT_EQ(one(line), "0.009 s  !! cut off after 6 bytes: 50 50 50 13 EC 07");
    line.hear(kAccept);
    line.lines();
    line.hear("42 99");
    line.hear(kSafe);
    EXPECT_EQ(one(line), "0.025 s  !! noise: 42 99");
    line.finish();
    line.lines();
    line.hear("52 52 52 10 EF 08 F7 04 FB 22 DD 33 CC AA AA");
    EXPECT_TRUE(one(line).starts_with("0.034 s  !! length and data do not fit: 52 52 52"));
    line.finish();
    line.lines();
    line.hear("50 50");
    line.wait(Microseconds{200'000});
    EXPECT_NE(one(line).find("!! cut off after 2 bytes: 50 50"), std::string::npos);
}

TEST(MactalkMonitor, AMessageThatStaysOpenIsCutOff) {
    auto line = mactalk_line();
    line.hear("50 50 50 13");
    line.wait(Microseconds{200'000});
    EXPECT_EQ(one(line), "0.000 s  !! cut off after 4 bytes: 50 50 50 13");
}

TEST(MactalkMonitor, AnAnswerToNothingAndToSomethingElse) {
    auto line = mactalk_line();
    line.hear(kReadReply);
    EXPECT_TRUE(one(line).starts_with("0.000 s  <- T_SOLL (7): 4711"));
    line.hear("50 50 50 13 EC 0A F5 AA AA");
    line.hear(kReadReply);
    const auto lines = line.lines();
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_NE(lines[0].find("no answer"), std::string::npos);
    EXPECT_NE(lines[1].find("an answer to no request that was heard"), std::string::npos);
}

TEST(MactalkMonitor, TwoStreams) {
    auto line = mactalk_line();
    line.hear(kRead, Side::master);
    line.hear(kReadReply, Side::motor);
    EXPECT_NE(one(line).find("read T_SOLL (7)   <- 4711"), std::string::npos);
    line.hear(kSafe, Side::motor);
    line.finish();
    EXPECT_NE(one(line).find("are the two ports exchanged?"), std::string::npos);
}

// Every place of the read, every other value: the damaged message is reported as a flaw, and the exchange
// that follows is understood. (Damage may make it another whole message only in the head: 50h to 53h..57h
// never, as all three bytes must be alike.)
TEST(MactalkMonitor, InStepAgainWithTheNextMessageAfterAnyDamage) {
    const Bytes read = from_hex(kRead);
    for (std::size_t at = 0; at < read.size(); ++at) {
        for (unsigned value = 0; value < 256; ++value) {
            if (value == read[at]) continue;
            auto line = mactalk_line();
            Bytes damaged = read;
            damaged[at] = static_cast<std::uint8_t>(value);
            line.hear(damaged);
            line.hear(kWrite);
            line.hear(kAccept);
            line.finish();
            const auto events = line.events();
            ASSERT_FALSE(events.empty());
            EXPECT_NE(events.front().flaw, "") << at << " " << value;
            bool understood = false;
            for (const auto& event : events)
                understood |=
                    event.request.find("write P_FNC") != std::string::npos && event.answer == "accepted";
            EXPECT_TRUE(understood) << at << " " << value;
        }
    }
}

// No byte is lost, whatever comes: what events hold is what was heard.
TEST(MactalkMonitor, EveryByteIsTold) {
    std::mt19937 random(11);
    const Bytes alphabet = from_hex("50 52 53 11 AA 55 00 FF 13 EC");
    for (int round = 0; round < 200; ++round) {
        auto line = mactalk_line();
        std::size_t told = 0;
        for (int i = 0; i < 500; ++i) line.hear(Bytes{alphabet[random() % alphabet.size()]});
        line.finish();
        for (const auto& event : line.events()) told += event.sent.size() + event.received.size();
        EXPECT_EQ(told, 500U) << "seed 11, round " << round;
    }
}

TEST(FastMacMonitor, TheManualsCommands) {
    auto line = fastmac_line();
    // 001 §5.2.1.4: E0h is command 0 with the toggle; 60h + 01h resets errors; 40h + 00010b is P_MODE with
    // P3.
    line.hear("E0 61 C2");
    EXPECT_EQ(line.lines(), (std::vector<std::string>{"0.000 s  -> E0 no operation, toggle 1",
                                                      "0.001 s  -> 61 reset errors, toggle 0",
                                                      "0.002 s  -> C2 P_MODE, use P3, toggle 1"}));
    line.hear("C2");
    EXPECT_TRUE(line.lines().empty()) << "a repeat does nothing";
    line.hear("E1");
    EXPECT_NE(one(line).find("the motor takes no such command"), std::string::npos);
}

TEST(FastMacMonitor, FlexMacBothWays) {
    auto line = fastmac_line();
    line.step = Microseconds{520};
    line.hear("FF", Side::master);
    line.lines();
    // 001 §5.2.2's example: V_SOLL (index 3) := 1000 = 03E8h, low byte first.
    line.hear("63 63 63 E8 17 03 FC", Side::master);
    EXPECT_TRUE(one(line).find("FlexMAC: write V_SOLL (5) := 03E8 = ") != std::string::npos);
    protocol::flexmac::Message read{.read = true, .longword = true, .target = 3};
    const auto request = protocol::flexmac::encode(read);
    line.hear(Bytes(request.view().begin(), request.view().end()), Side::master);
    EXPECT_NE(one(line).find("FlexMAC: read P_IST (10)"), std::string::npos);
    const auto reply = protocol::flexmac::encode_reply(read, 4660);
    line.hear(Bytes(reply.view().begin(), reply.view().end()), Side::motor);
    EXPECT_NE(one(line).find("read P_IST (10) is 00001234 = 4660 counts"), std::string::npos);
    line.hear("7E 7E 7E", Side::master);
    EXPECT_NE(one(line).find("FlexMAC: use FastMAC"), std::string::npos);
    line.hear("61", Side::master);
    EXPECT_NE(one(line).find("reset errors"), std::string::npos);
}

TEST(FastMacMonitor, ABrokenMessageIsTold) {
    auto line = fastmac_line();
    line.step = Microseconds{520};
    line.hear("FF");
    line.lines();
    line.hear("63 63 63 E8 16");
    line.finish();
    EXPECT_NE(one(line).find("no whole FlexMAC message: 63 63 63 E8 16"), std::string::npos);
}

TEST(FastMacMonitor, StatusIsToldWhenItChanges) {
    auto line = fastmac_line();
    line.hear("10 10 10 90 91", Side::motor);
    EXPECT_EQ(line.lines(),
              (std::vector<std::string>{"0.000 s  <- 10 status: toggle 0, in position",
                                        "0.003 s  <- 90 status: toggle 1, in position",
                                        "0.004 s  <- 91 status: toggle 1, in position, ERROR"}));
}

/// Requests without answers, answers without requests, damaged ones and noise, of all three lines.
TEST(MonitorOrder, TimesAscendAndNothingIsLost) {
    const std::vector<std::string> parts{"50 50 50 08 F7 0A F5 AA AA",
                                         "52 52 52 00 FF 0A F5 04 FB 34 CB 12 ED 00 FF 00 FF AA AA",
                                         "11 11 11",
                                         "50 50 50 08",
                                         "42 43",
                                         "02 30 31 34",
                                         "E1 61",
                                         "63 63 63 E8 17 03 FC",
                                         "52 52 52 08 F7 05 FA 02 FD 58 A7 02 FD AA AA"};
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        std::mt19937 random(seed);
        const auto monitor = seed % 3 == 0   ? make_midi_monitor({})
                             : seed % 3 == 1 ? make_mactalk_monitor({})
                                             : make_fastmac_monitor({});
        const auto plain = seed % 3 == 0   ? make_midi_monitor({})
                           : seed % 3 == 1 ? make_mactalk_monitor({})
                                           : make_fastmac_monitor({});
        InOrder order;
        std::vector<MonitorEvent> told;
        std::size_t found = 0;
        const auto take = [&] {
            for (MonitorEvent& event : order.take(*monitor)) told.push_back(std::move(event));
            found += plain->take().size();
        };
        Instant now{};
        for (int i = 0; i < 200; ++i) {
            const Side side = static_cast<Side>(random() % 3);
            for (const std::uint8_t byte : from_hex(parts[random() % parts.size()])) {
                for (Monitor* one : {monitor.get(), plain.get()}) one->receive(side, byte, now);
                now += Microseconds{520};
                take();
            }
            now += Microseconds{random() % 4 == 0 ? 400'000 : 5'000};
            for (Monitor* one : {monitor.get(), plain.get()}) one->pass(now);
            take();
        }
        for (Monitor* one : {monitor.get(), plain.get()}) one->finish();
        take();
        EXPECT_EQ(told.size(), found) << "seed " << seed;
        EXPECT_TRUE(std::is_sorted(told.begin(), told.end(),
                                   [](const MonitorEvent& a, const MonitorEvent& b) { return a.at < b.at; }))
            << "seed " << seed;
    }
}

TEST(MonitorWords, NumbersThatAreNoRegistersOwn) {
    EXPECT_EQ(register_words(registers::Model::mac140, 11), "upper word of P_IST (11)");
    EXPECT_EQ(register_words(registers::Model::mac140, 250), "register 250");
}

}  // namespace
}  // namespace nplc::macreg
