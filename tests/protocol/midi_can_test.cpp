#include "protocol/midi_can.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace nplc::protocol::midi_can {
namespace {

using Ask = Request::Kind;
using Say = Answer::Kind;

/// "601 23 13 20 00 00 00 03 E8": identifier and bytes.
base::CanFrame frame(const std::string& line) {
    base::CanFrame frame;
    std::size_t at = 0;
    frame.id = static_cast<std::uint16_t>(std::stoul(line, &at, 16));
    for (; at + 2 < line.size() + 1 && at < line.size(); at += 3) {
        frame.data[frame.length] = static_cast<std::uint8_t>(std::stoul(line.substr(at + 1, 2), nullptr, 16));
        ++frame.length;
    }
    return frame;
}

struct RequestExample {
    const char* frame;
    Request request;
};

// 003 §V.4 to §V.8 and every frame of §VII; x are 0. Data high byte first: 03h E8h is 1000.
// clang-format off
const RequestExample kRequests[] = {
    {"080", {.kind = Ask::sync}},
    {"7E5 04 01 00 00 00 00 00 00", {.kind = Ask::configure}},
    {"7E5 11 05 00 00 00 00 00 00", {.kind = Ask::set_address, .data = 5}},
    {"7E5 04 00 00 00 00 00 00 00", {.kind = Ask::operate}},
    {"601 23 00 20 00 00 00 00 00", {Ask::command, 1, 0x2000, 0, 0}},
    {"601 23 01 20 00 00 00 00 00", {Ask::command, 1, 0x2001, 0, 0}},
    {"601 23 02 20 00 00 00 00 00", {Ask::command, 1, 0x2002, 0, 0}},
    {"601 23 02 20 00 00 00 00 01", {Ask::command, 1, 0x2002, 0, 1}},
    {"601 23 03 20 00 00 00 00 00", {Ask::command, 1, 0x2003, 0, 0}},
    {"601 23 03 20 00 00 00 00 01", {Ask::command, 1, 0x2003, 0, 1}},
    {"601 23 03 20 00 00 00 00 08", {Ask::command, 1, 0x2003, 0, 8}},
    {"601 23 03 20 00 00 00 00 09", {Ask::command, 1, 0x2003, 0, 9}},
    {"601 23 07 20 00 00 00 00 00", {Ask::command, 1, 0x2007, 0, 0}},
    {"601 23 07 20 00 00 00 00 01", {Ask::command, 1, 0x2007, 0, 1}},
    {"601 23 09 20 00 00 01 86 A0", {Ask::command, 1, 0x2009, 0, 100000}},
    {"601 23 0A 20 00 FF FE 79 60", {Ask::command, 1, 0x200A, 0, 0xFFFE7960}},  // -100000
    {"601 23 0B 20 00 00 00 00 00", {Ask::command, 1, 0x200B, 0, 0}},
    {"601 23 0C 20 00 00 00 00 40", {Ask::command, 1, 0x200C, 0, 0x40}},
    {"601 23 0D 20 00 00 00 01 E0", {Ask::command, 1, 0x200D, 0, 480}},
    {"601 23 0E 20 00 00 00 05 00", {Ask::command, 1, 0x200E, 0, 0x500}},
    {"601 23 0F 20 00 00 00 00 10", {Ask::command, 1, 0x200F, 0, 0x10}},
    {"601 23 10 20 00 00 00 00 00", {Ask::command, 1, 0x2010, 0, 0}},
    {"601 23 11 20 00 00 00 00 00", {Ask::command, 1, 0x2011, 0, 0}},
    {"67F 23 13 20 00 00 00 03 E8", {Ask::command, 127, 0x2013, 0, 1000}},
    {"601 23 14 20 00 00 00 00 00", {Ask::command, 1, 0x2014, 0, 0}},
    {"601 23 15 20 00 00 00 03 20", {Ask::command, 1, 0x2015, 0, 0x320}},
    {"601 23 15 20 00 00 00 00 00", {Ask::command, 1, 0x2015, 0, 0}},  // the run ends
    {"601 23 15 20 00 00 F6 03 20", {Ask::command, 1, 0x2015, 0, 0xF60320}},
    {"601 23 16 20 00 03 E8 10 00", {Ask::command, 1, 0x2016, 0, 0x03E81000}},  // §VII 1Eh, printed with 681h
    {"602 23 1E 20 00 03 E8 10 00", {Ask::command, 2, 0x201E, 0, 0x03E81000}},  // printed with 682h
    {"601 23 17 20 00 00 00 00 00", {Ask::command, 1, 0x2017, 0, 0}},
    {"601 23 18 20 00 00 00 00 00", {Ask::command, 1, 0x2018, 0, 0}},
    {"601 23 19 20 00 00 00 00 00", {Ask::command, 1, 0x2019, 0, 0}},
    {"601 23 1A 20 00 00 00 00 00", {Ask::command, 1, 0x201A, 0, 0}},
    {"601 23 1C 20 00 00 00 00 14", {Ask::command, 1, 0x201C, 0, 20}},
    {"601 40 00 20 00 00 00 00 00", {Ask::query, 1, 0x2000, 0, 0}},
    {"601 40 01 20 00 00 00 00 00", {Ask::query, 1, 0x2001, 0, 0}},
    {"601 40 02 20 00 00 00 00 00", {Ask::query, 1, 0x2002, 0, 0}},
    {"601 40 03 20 00 00 00 00 00", {Ask::query, 1, 0x2003, 0, 0}},
    {"601 40 04 20 00 00 00 00 00", {Ask::query, 1, 0x2004, 0, 0}},
    {"601 40 05 20 00 00 00 00 00", {Ask::query, 1, 0x2005, 0, 0}},
    {"601 40 06 20 00 00 00 00 00", {Ask::query, 1, 0x2006, 0, 0}},
    {"601 40 07 20 00 00 00 00 00", {Ask::query, 1, 0x2007, 0, 0}},
    {"601 40 08 20 AF 00 00 00 00", {Ask::query, 1, 0x2008, 0xAF, 0}},
    {"600 23 18 20 00 00 00 00 00", {Ask::command, kGeneral, 0x2018, 0, 0}},
};

struct AnswerExample {
    const char* frame;
    Answer answer;
};

const AnswerExample kAnswers[] = {
    {"701 00", {.kind = Say::booted, .address = 1}},
    {"77F 00", {.kind = Say::booted, .address = 127}},
    {"7E4 11 00 00 00 00 00 00 00", {.kind = Say::address_taken}},
    {"581 60 13 20 00 00 00 00 00", {Say::accepted, 1, 0x2013, 0, 0}},
    {"5FF 80 13 20 00 00 00 00 00", {Say::refused, 127, 0x2013, 0, 0}},
    {"581 42 00 20 00 FF FF FC 18", {Say::value, 1, 0x2000, 0, 0xFFFFFC18}},  // position -1000
    {"581 42 01 20 00 40 03 00 80", {Say::value, 1, 0x2001, 0, 0x40030080}},
    {"581 42 02 20 00 00 01 86 A0", {Say::value, 1, 0x2002, 0, 100000}},
    {"581 42 03 20 00 FF FE 79 60", {Say::value, 1, 0x2003, 0, 0xFFFE7960}},
    {"581 42 04 20 00 00 00 07 04", {Say::value, 1, 0x2004, 0, 0x704}},
    {"581 42 05 20 00 05 00 01 E0", {Say::value, 1, 0x2005, 0, 0x050001E0}},
    {"581 42 06 20 00 10 40 19 14", {Say::value, 1, 0x2006, 0, 0x10401914}},
    {"581 42 07 20 00 50 78 08 00", {Say::value, 1, 0x2007, 0, 0x50780800}},
    {"581 42 08 20 AF 80 00 00 00", {Say::value, 1, 0x2008, 0xAF, 0x80000000}},
};
// clang-format on

TEST(MidiCan, RequestsAreEncoded) {
    for (const auto& example : kRequests)
        EXPECT_EQ(encode(example.request), frame(example.frame)) << example.frame;
}

TEST(MidiCan, RequestsAreDecoded) {
    for (const auto& example : kRequests)
        EXPECT_EQ(decode_request(frame(example.frame)), example.request) << example.frame;
}

TEST(MidiCan, AnswersAreEncoded) {
    for (const auto& example : kAnswers)
        EXPECT_EQ(encode_answer(example.answer), frame(example.frame)) << example.frame;
}

TEST(MidiCan, AnswersAreDecoded) {
    for (const auto& example : kAnswers)
        EXPECT_EQ(decode_answer(frame(example.frame)), example.answer) << example.frame;
}

TEST(MidiCan, WhatAMasterAlsoTakes) {
    // CiA 301's command byte, any abort code, and 601h as 003 §V.8 prints it.
    EXPECT_EQ(decode_answer(frame("581 43 00 20 00 00 00 00 07")), (Answer{Say::value, 1, 0x2000, 0, 7}));
    EXPECT_EQ(decode_answer(frame("581 80 13 20 00 00 00 02 06")),
              (Answer{Say::refused, 1, 0x2013, 0, 0x206}));
    EXPECT_EQ(decode_answer(frame("601 60 18 20 00 00 00 00 00")), (Answer{Say::accepted, 1, 0x2018, 0, 0}));
    EXPECT_EQ(decode_answer(frame("7E4 11 01 00 00 00 00 00 00")).kind, Say::address_refused);
    // ... which no module takes for a request, nor a request for an answer.
    EXPECT_EQ(decode_request(frame("601 60 18 20 00 00 00 00 00")).kind, Ask::none);
    EXPECT_EQ(decode_answer(frame("601 23 18 20 00 00 00 00 00")).kind, Say::none);
}

/// 003 §V.5 and §V.6 use the first two bytes only.
TEST(MidiCan, ServicesOfTwoBytes) {
    EXPECT_EQ(decode_request(frame("7E5 04 01")).kind, Ask::configure);
    EXPECT_EQ(decode_request(frame("7E5 11 05")), (Request{.kind = Ask::set_address, .data = 5}));
    EXPECT_EQ(decode_answer(frame("7E4 11 00")).kind, Say::address_taken);
    EXPECT_EQ(encode_answer({.kind = Say::address_refused}), frame("7E4 11 01 00 00 00 00 00 00"));
}

TEST(MidiCan, OtherSdoFormsAreForTheModuleToRefuse) {
    EXPECT_EQ(decode_request(frame("601 2F 0F 20 00 10 00 00 00")).kind, Ask::other);
    EXPECT_EQ(decode_request(frame("601 21 0F 20 00 10 00 00 00")).kind, Ask::other);
    EXPECT_EQ(decode_request(frame("601 23 0F 10 00 00 00 00 10")).index, 0x100F);  // no index of 20xxh
}

TEST(MidiCan, FramesThatMeanNothing) {
    for (const char* line : {"080 01", "000 81 01", "681 23 16 20 00 03 E8 10 00", "601 23 16 20 00 03 E8 10",
                             "601", "581 42 00 20 00 00 00 00 00", "7E5 04", "7E5 04 02 00 00 00 00 00 00",
                             "7E5 12 01 00 00 00 00 00 00", "7E5", "701 00", "7E4 11 00 00"})
        EXPECT_EQ(decode_request(frame(line)).kind, Ask::none) << line;
    for (const char* line :
         {"700 00", "780 00", "701 05", "701 00 00", "701", "580 60 13 20 00 00 00 00 00",
          "600 60 13 20 00 00 00 00 00", "602 60 13 20 00 00 00 00 00", "581 60 13 20 00 00 00 00",
          "581 23 13 20 00 00 00 00 00", "7E4 04 00 00", "7E4 11", "080"})
        EXPECT_EQ(decode_answer(frame(line)).kind, Say::none) << line;
}

TEST(MidiCan, AnAnswerFitsItsRequest) {
    const Request go{Ask::command, 1, 0x2013, 0, 1000};
    const Request position{Ask::query, 1, 0x2000, 0, 0};
    EXPECT_TRUE(answers({Say::accepted, 1, 0x2013, 0, 0}, go));
    EXPECT_TRUE(answers({Say::refused, 1, 0x2013, 0, 0}, go));
    EXPECT_FALSE(answers({Say::accepted, 2, 0x2013, 0, 0}, go));
    EXPECT_FALSE(answers({Say::accepted, 1, 0x2014, 0, 0}, go));
    EXPECT_FALSE(answers({Say::accepted, 1, 0x2013, 1, 0}, go));
    EXPECT_FALSE(answers({Say::value, 1, 0x2013, 0, 0}, go));
    EXPECT_FALSE(answers({.kind = Say::booted, .address = 1}, go));
    EXPECT_TRUE(answers({Say::value, 1, 0x2000, 0, 7}, position));
    EXPECT_FALSE(answers({Say::accepted, 1, 0x2000, 0, 0}, position));
    // Module 1 answers for all (003 §V.8), and RAM readings with any sub-index (003 §VII 08h).
    EXPECT_TRUE(answers({Say::accepted, 1, 0x2018, 0, 0}, {Ask::command, kGeneral, 0x2018, 0, 0}));
    EXPECT_FALSE(answers({Say::accepted, 2, 0x2018, 0, 0}, {Ask::command, kGeneral, 0x2018, 0, 0}));
    EXPECT_TRUE(answers({Say::value, 1, 0x2008, 0, 0}, {Ask::query, 1, 0x2008, 0xAF, 0}));
    EXPECT_FALSE(answers({Say::value, 1, 0x2000, 1, 0}, position));
    EXPECT_FALSE(answers({Say::accepted, 1, 0x2008, 1, 0}, {Ask::command, 1, 0x2008, 0, 0}));
    EXPECT_FALSE(answers({.kind = Say::accepted}, {.kind = Ask::configure}));
    EXPECT_FALSE(answers({}, {}));
}

TEST(MidiCan, WhatNobodySendsIsEmpty) {
    EXPECT_EQ(encode({}), base::CanFrame{});
    EXPECT_EQ(encode({.kind = Ask::other, .address = 1}), base::CanFrame{});
    EXPECT_EQ(encode_answer({}), base::CanFrame{});
}

TEST(MidiCanRandom, EveryRequestAndAnswerComesBack) {
    constexpr unsigned kSeed = 9;
    std::mt19937 random(kSeed);
    for (int i = 0; i < 50'000; ++i) {
        const auto address = static_cast<std::uint8_t>(1 + random() % 127);
        const auto index = static_cast<std::uint16_t>(random());
        const auto sub_index = static_cast<std::uint8_t>(random());
        const auto data = static_cast<std::uint32_t>(random());
        const Request request{random() % 2 == 0 ? Ask::command : Ask::query, address, index, sub_index, data};
        ASSERT_EQ(decode_request(encode(request)), request) << "seed " << kSeed << ", round " << i;
        const Say kinds[] = {Say::accepted, Say::refused, Say::value};
        const Answer answer{kinds[random() % 3], address, index, sub_index, data};
        ASSERT_EQ(decode_answer(encode_answer(answer)), answer) << "seed " << kSeed << ", round " << i;
    }
}

}  // namespace
}  // namespace nplc::protocol::midi_can
