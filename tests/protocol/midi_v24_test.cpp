#include "protocol/midi_v24.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "midi_v24_text.h"

namespace nplc::protocol::midi_v24 {
namespace {

struct RequestExample {
    const char* where;
    Request request;
    const char* inside;  ///< between Stx and Etx; blanks are for the eye
};

struct ReplyExample {
    const char* where;
    Reply reply;
    const char* inside;
};

// The frames of 000 §VI. The sum of the first: 11 x 30h + 31h + 35h + 33h + 32h = 2ABh (000 §VI); 14 digits 0
// alone have 2A0h, so every sum is A0h plus what the other characters have above '0' (1: 1 .. 9: 9, A: 11h ..
// F: 16h).
// clang-format off
const RequestExample kRequests[] = {
    {"000 §VI, the worked example: 300 rpm on a MAC23", {0x00, 0x15, 0x00, 0x00000320}, "014 00 15 00 00000320 AB"},
    {"00h", {0x01, 0x00, 0x00, 0x00000000}, "014 01 00 00 00000000 A1"},
    {"01h", {0x01, 0x01, 0x00, 0x00000000}, "014 01 01 00 00000000 A2"},
    {"02h standby", {0x01, 0x02, 0x00, 0x00000001}, "014 01 02 00 00000001 A4"},
    {"02h nominal current", {0x01, 0x02, 0x00, 0x00000000}, "014 01 02 00 00000000 A3"},
    {"03h none", {0x01, 0x03, 0x00, 0x00000000}, "014 01 03 00 00000000 A4"},
    {"03h hardware", {0x01, 0x03, 0x00, 0x00000001}, "014 01 03 00 00000001 A5"},
    {"03h software", {0x01, 0x03, 0x00, 0x00000008}, "014 01 03 00 00000008 AC"},
    {"03h both", {0x01, 0x03, 0x00, 0x00000009}, "014 01 03 00 00000009 AD"},
    {"07h on", {0x01, 0x07, 0x00, 0x00000001}, "014 01 07 00 00000001 A9"},
    {"07h off", {0x01, 0x07, 0x00, 0x00000000}, "014 01 07 00 00000000 A8"},
    {"08h, to all: address 05h", {0xFF, 0x08, 0x00, 0x00000005}, "014 FF 08 00 00000005 D9"},
    {"09h +100000", {0x01, 0x09, 0x00, 0x000186A0}, "014 01 09 00 000186A0 CA"},
    {"0Ah -100000", {0x01, 0x0A, 0x00, 0xFFFE7960}, "014 01 0A 00 FFFE7960 1F"},
    {"0Bh", {0x01, 0x0B, 0x00, 0x00000000}, "014 01 0B 00 00000000 B3"},
    {"0Ch 40h", {0x01, 0x0C, 0x00, 0x00000040}, "014 01 0C 00 00000040 B8"},
    {"0Dh 01E0h: 100 rpm on a MAC34", {0x01, 0x0D, 0x00, 0x000001E0}, "014 01 0D 00 000001E0 CB"},
    {"0Eh 05h", {0x01, 0x0E, 0x00, 0x00000500}, "014 01 0E 00 00000500 BB"},
    {"0Fh 10h", {0x01, 0x0F, 0x00, 0x00000010}, "014 01 0F 00 00000010 B8"},
    {"10h", {0x01, 0x10, 0x00, 0x00000000}, "014 01 10 00 00000000 A2"},
    {"11h", {0x01, 0x11, 0x00, 0x00000000}, "014 01 11 00 00000000 A3"},
    {"13h -1", {0x7F, 0x13, 0x00, 0xFFFFFFFF}, "014 7F 13 00 FFFFFFFF 71"},
    {"14h", {0x01, 0x14, 0x00, 0x00000000}, "014 01 14 00 00000000 A6"},
    {"15h counter-clockwise", {0x01, 0x15, 0x00, 0x00F60320}, "014 01 15 00 00F60320 C8"},
    {"15h clockwise", {0x01, 0x15, 0x00, 0x00000320}, "014 01 15 00 00000320 AC"},
    {"16h 000 §VI 1Eh: motor 00 moves", {0x00, 0x16, 0x00, 0x03E81000}, "014 00 16 00 03E81000 C8"},
    {"1Eh 000 §VI 1Eh: motor 01 waits", {0x01, 0x1E, 0x00, 0x03E81000}, "014 01 1E 00 03E81000 D8"},
    {"17h", {0x01, 0x17, 0x00, 0x00000000}, "014 01 17 00 00000000 A9"},
    {"18h", {0x01, 0x18, 0x00, 0x00000000}, "014 01 18 00 00000000 AA"},
    {"19h", {0x01, 0x19, 0x00, 0x00000000}, "014 01 19 00 00000000 AB"},
    {"1Ah", {0x01, 0x1A, 0x00, 0x00000000}, "014 01 1A 00 00000000 B3"},
    {"1Bh 9600 baud", {0x01, 0x1B, 0x00, 0x00000001}, "014 01 1B 00 00000001 B5"},
    {"1Bh 19200 baud", {0x01, 0x1B, 0x00, 0x00000002}, "014 01 1B 00 00000002 B6"},
    {"1Bh 38400 baud", {0x01, 0x1B, 0x00, 0x00000003}, "014 01 1B 00 00000003 B7"},
    {"1Ch 14h", {0x01, 0x1C, 0x00, 0x00000014}, "014 01 1C 00 00000014 BA"},
    {"20h", {0x01, 0x20, 0x00, 0x00000000}, "014 01 20 00 00000000 A3"},
    {"21h", {0x01, 0x21, 0x00, 0x00000000}, "014 01 21 00 00000000 A4"},
    {"22h", {0x01, 0x22, 0x00, 0x00000000}, "014 01 22 00 00000000 A5"},
    {"23h", {0x01, 0x23, 0x00, 0x00000000}, "014 01 23 00 00000000 A6"},
    {"24h", {0x01, 0x24, 0x00, 0x00000000}, "014 01 24 00 00000000 A7"},
    {"25h", {0x01, 0x25, 0x00, 0x00000000}, "014 01 25 00 00000000 A8"},
    {"26h", {0x01, 0x26, 0x00, 0x00000000}, "014 01 26 00 00000000 A9"},
    {"27h", {0x01, 0x27, 0x00, 0x00000000}, "014 01 27 00 00000000 AA"},
    {"28h Imax, at AFh", {0x00, 0x28, 0xAF, 0x00000000}, "014 00 28 AF 00000000 D1"},
    {"29h", {0x01, 0x29, 0x10, 0x00000000}, "014 01 29 10 00000000 AD"},
};

// The replies of 000 §VI. Eleven digits 0 have 210h. 28h's is printed with 014, a misprint.
const ReplyExample kReplies[] = {
    {"20h -1000", {0x01, 0, 0xFFFFFC18}, "011 01 0 FFFFFC18 9B"},
    {"21h", {0x01, 1, 0x40030080}, "011 01 1 40030080 21"},
    {"22h", {0x01, 2, 0x000186A0}, "011 01 2 000186A0 33"},
    {"23h", {0x01, 3, 0xFFFE7960}, "011 01 3 FFFE7960 81"},
    {"24h", {0x01, 4, 0x00000704}, "011 01 4 00000704 20"},
    {"25h", {0x01, 5, 0x050001E0}, "011 01 5 050001E0 31"},
    {"26h", {0x01, 6, 0x10401914}, "011 01 6 10401914 2B"},
    {"27h", {0x01, 7, 0x50780800}, "011 01 7 50780800 34"},
    {"28h Imax 80h", {0x00, 8, 0x80000000}, "011 00 8 80000000 20"},
    {"29h", {0x01, 9, 0x12345678}, "011 01 9 12345678 3E"},
};
// clang-format on

std::string frame(const char* inside) {
    std::string characters = inside;
    std::erase(characters, ' ');
    return framed(characters);
}

/// What 000 §V and §VI have an index of; each must be among the examples.
constexpr std::uint8_t kIndices[] = {0x00, 0x01, 0x02, 0x03, 0x07, 0x08, 0x09, 0x0A, 0x0B, 0x0C, 0x0D, 0x0E,
                                     0x0F, 0x10, 0x11, 0x13, 0x14, 0x15, 0x16, 0x17, 0x18, 0x19, 0x1A, 0x1B,
                                     0x1C, 0x1E, 0x20, 0x21, 0x22, 0x23, 0x24, 0x25, 0x26, 0x27, 0x28, 0x29};

TEST(MidiV24, EveryFrameOfTheManualIsAnExample) {
    for (const std::uint8_t index : kIndices) {
        EXPECT_TRUE(std::any_of(std::begin(kRequests), std::end(kRequests), [index](const RequestExample& e) {
            return e.request.index == index;
        })) << int{index};
        EXPECT_TRUE(!is_query(index) ||
                    std::any_of(std::begin(kReplies), std::end(kReplies),
                                [index](const ReplyExample& e) { return e.reply.digit == digit_of(index); }))
            << int{index};
    }
}

// 000 §VI, character by character.
TEST(MidiV24, TheWorkedExampleByteByByte) {
    const RequestBytes printed{0x02, 0x30, 0x31, 0x34, 0x30, 0x30, 0x31, 0x35, 0x30, 0x30, 0x30,
                               0x30, 0x30, 0x30, 0x30, 0x33, 0x32, 0x30, 0x41, 0x42, 0x03};
    EXPECT_EQ(encode({.index = 0x15, .data = 800}), printed);
    const auto events = events_in(text(printed));
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].request, (Request{.index = 0x15, .data = 0x320}));
}

TEST(MidiV24, RequestsAreEncoded) {
    for (const RequestExample& example : kRequests) {
        EXPECT_EQ(text(encode(example.request)), frame(example.inside)) << example.where;
    }
}

TEST(MidiV24, RequestsAreDecoded) {
    for (const RequestExample& example : kRequests) {
        const auto events = events_in(frame(example.inside));
        ASSERT_EQ(events.size(), 1u) << example.where;
        EXPECT_EQ(events[0].kind, RequestDecoder::Event::Kind::request) << example.where;
        EXPECT_EQ(events[0].request, example.request) << example.where;
    }
}

TEST(MidiV24, RepliesAreEncoded) {
    for (const ReplyExample& example : kReplies) {
        EXPECT_EQ(text(encode_reply(example.reply)), frame(example.inside)) << example.where;
    }
}

TEST(MidiV24, RepliesAreDecoded) {
    for (const ReplyExample& example : kReplies) {
        const Request asked{.address = example.reply.address,
                            .index = static_cast<std::uint8_t>(kFirstQuery + example.reply.digit)};
        const auto answers = answers_in(asked, "\x06\x13" + frame(example.inside) + "\x1A");
        ASSERT_EQ(answers.size(), 1u) << example.where;
        EXPECT_EQ(answers[0], (Answer{Kind::value, example.reply.data})) << example.where;
    }
}

// 000 §II, reception.
TEST(MidiV24, TheThreeAnswersToACommand) {
    const Request go{.address = 1, .index = 0x13, .data = 1000};
    for (const auto& [bytes, kind] :
         {std::pair{"\x06\x13\x1A", Kind::accepted}, std::pair{"\x15", Kind::not_understood},
          std::pair{"\x06\x13\x17", Kind::refused}, std::pair{"\x06\x13\x18", Kind::refused}}) {
        const auto answers = answers_in(go, bytes);
        ASSERT_EQ(answers.size(), 1u);
        EXPECT_EQ(answers[0], (Answer{kind, 0}));
    }
}

TEST(MidiV24, AnAnswerIsReportedWithItsLastCharacterOnly) {
    AnswerDecoder decoder;
    decoder.expect({.address = 1, .index = 0x13});
    EXPECT_EQ(decoder.receive(kAck).kind, Kind::none);
    EXPECT_EQ(decoder.receive(kXoff).kind, Kind::none);
    EXPECT_TRUE(decoder.waiting());
    EXPECT_EQ(decoder.receive(kXon).kind, Kind::accepted);
    EXPECT_FALSE(decoder.waiting());
    EXPECT_EQ(decoder.receive(kAck).kind, Kind::none);
    EXPECT_EQ(decoder.receive(kXonError).kind, Kind::none);
}

TEST(MidiV24, WhatDoesNotAnswerTheRequestIsUnclear) {
    const Request query{.address = 1, .index = 0x20};
    const std::string good = text(encode_reply({.address = 1, .digit = 0, .data = 5}));
    const std::string other_module = text(encode_reply({.address = 2, .digit = 0, .data = 5}));
    const std::string other_digit = text(encode_reply({.address = 1, .digit = 2, .data = 5}));
    for (const std::string& bytes :
         {"\x06\x13" + other_module + "\x1A", "\x06\x13" + other_digit + "\x1A",
          "\x06\x13" + good + good + "\x1A", std::string("\x06\x13\x1A"), "\x13" + good + "\x1A",
          "\x06\x13" + good.substr(0, 9) + "\x1A", std::string("\x06\x15"), std::string("\x17"),
          // Behind a part of a reply: something is lost.
          "\x06\x13" + good.substr(0, 9) + good + "\x1A",
          "\x06\x13" + good.substr(0, 9) + "\x13" + good + "\x1A", "\x06\x13\x02" + ("9" + good) + "\x1A"}) {
        const auto answers = answers_in(query, bytes);
        ASSERT_EQ(answers.size(), 1u);
        EXPECT_EQ(answers[0], (Answer{Kind::unclear, 0}));
    }
    // A command that brings a value.
    EXPECT_EQ(answers_in({.address = 1, .index = 0x13}, "\x06\x13" + good + "\x1A")[0].kind, Kind::unclear);
}

// 000 §III against §VI: 21h and 23h with the digit of 22h, and 28h with the length of a request.
TEST(MidiV24, TheManualsMisprintsAreNoAnswers) {
    for (const auto& [index, inside] :
         {std::pair{0x21, "011 01 2 00000000 13"}, std::pair{0x23, "011 01 2 00000000 13"},
          std::pair{0x28, "014 01 8 80000000 21"}}) {
        const Request asked{.address = 1, .index = static_cast<std::uint8_t>(index)};
        const auto answers = answers_in(asked, "\x06\x13" + frame(inside) + "\x1A");
        ASSERT_EQ(answers.size(), 1u) << inside;
        EXPECT_EQ(answers[0].kind, Kind::unclear) << inside;
    }
}

TEST(MidiV24, AGeneralQueryIsAnsweredByModuleZero) {
    const Request query{.address = kGeneral, .index = 0x20};
    for (const std::uint8_t from : {std::uint8_t{0}, kGeneral}) {
        const std::string reply = text(encode_reply({.address = from, .digit = 0, .data = 5}));
        EXPECT_EQ(answers_in(query, "\x06\x13" + reply + "\x1A")[0], (Answer{Kind::value, 5}));
    }
    const std::string wrong = text(encode_reply({.address = 1, .digit = 0, .data = 5}));
    EXPECT_EQ(answers_in(query, "\x06\x13" + wrong + "\x1A")[0].kind, Kind::unclear);
}

TEST(MidiV24, AnotherRequestBeginsAnew) {
    const Request query{.address = 1, .index = 0x20};
    const std::string good = text(encode_reply({.address = 1, .digit = 0, .data = 5}));
    AnswerDecoder decoder;
    decoder.expect(query);
    EXPECT_TRUE(feed(decoder, "\x06\x13" + good.substr(0, 9)).empty());
    decoder.expect(query);
    const auto answers = feed(decoder, "\x06\x13" + good + "\x1A");
    ASSERT_EQ(answers.size(), 1u);
    EXPECT_EQ(answers[0], (Answer{Kind::value, 5}));
}

TEST(MidiV24, ALineThatNobodyAskedSaysNothing) {
    AnswerDecoder decoder;
    EXPECT_TRUE(feed(decoder, "\x06\x13\x1A\x15\x17").empty());
    decoder.expect({.address = 1, .index = 0x13});
    decoder.abandon();
    EXPECT_TRUE(feed(decoder, "\x06\x13\x1A").empty());
}

}  // namespace
}  // namespace nplc::protocol::midi_v24
