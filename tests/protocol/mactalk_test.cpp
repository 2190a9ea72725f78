#include "protocol/mactalk.h"

#include <gtest/gtest.h>

#include "mactalk_bytes.h"

namespace nplc::protocol::mactalk {
namespace {

struct RequestExample {
    const char* where;
    Request request;
    const char* bytes;
};

// As printed, with two misprints mended: 002 and 004 have 05h,F6h for register 5 where its inverse is FAh,
// and 001's text calls 4711h "big-endian" though its bytes come low first.
const RequestExample kRequests[] = {
    {"001 §5.1 read 7 of unit 13h", {Kind::read, 0x13, 7, 0, 0}, "50 50 50 13 EC 07 F8 AA AA"},
    {"001 §5.1 write 3322h to 8 of unit 10h",
     {Kind::write, 0x10, 8, 2, 0x3322},
     "52 52 52 10 EF 08 F7 02 FD 22 DD 33 CC AA AA"},
    {"001 §5.1 safe mode, unit 17h", {Kind::safe_mode, 0x17, 0, 0, 0}, "54 54 54 17 E8 AA AA"},
    {"002 §5.7.2 write 600 to 5",
     {Kind::write, 8, 5, 2, 600},
     "52 52 52 08 F7 05 FA 02 FD 58 A7 02 FD AA AA"},
    {"002 §5.7.2, 004 §1.3.2 write 230,000 to 3",
     {Kind::write, 7, 3, 4, 230'000},
     "52 52 52 07 F8 03 FC 04 FB 70 8F 82 7D 03 FC 00 FF AA AA"},
    {"002 §5.7.3, 004 §1.3.3 read 5", {Kind::read, 8, 5, 0, 0}, "50 50 50 08 F7 05 FA AA AA"},
    {"002 §5.7.3, 004 §1.3.3 read 3", {Kind::read, 8, 3, 0, 0}, "50 50 50 08 F7 03 FC AA AA"},
    {"002 §5.7.4 mode 1", {Kind::write, 8, 2, 2, 1}, "52 52 52 08 F7 02 FD 02 FD 01 FE 00 FF AA AA"},
    {"002 §5.7.4, 004 §1.3.4 position 100,000",
     {Kind::write, 7, 3, 4, 100'000},
     "52 52 52 07 F8 03 FC 04 FB A0 5F 86 79 01 FE 00 FF AA AA"},
    {"002 §5.7.4, 004 §1.3.4 read 35", {Kind::read, 8, 35, 0, 0}, "50 50 50 08 F7 23 DC AA AA"},
    {"002 §5.7.4 speed 2097", {Kind::write, 8, 5, 2, 2097}, "52 52 52 08 F7 05 FA 02 FD 31 CE 08 F7 AA AA"},
    {"002 §5.7.4, 004 §1.3.4 read 10", {Kind::read, 8, 10, 0, 0}, "50 50 50 08 F7 0A F5 AA AA"},
    {"004 §1.3.2 write 600 to 5",
     {Kind::write, 8, 5, 4, 600},
     "52 52 52 08 F7 05 FA 04 FB 58 A7 02 FD 00 FF 00 FF AA AA"},
    {"004 §1.3.4 mode 1",
     {Kind::write, 8, 2, 4, 1},
     "52 52 52 08 F7 02 FD 04 FB 01 FE 00 FF 00 FF 00 FF AA AA"},
    {"004 §1.3.4 speed 2771",
     {Kind::write, 8, 5, 4, 0xAD3},
     "52 52 52 08 F7 05 FA 04 FB D3 2C 0A F5 00 FF 00 FF AA AA"},
    // By the grammar of 001 §5.1, which has no example for these.
    {"block", {Kind::read_block, 1, 16, 0, 0}, "51 51 51 01 FE 10 EF AA AA"},
    {"samples", {Kind::read_samples, 0xFE, 0, 0, 0}, "53 53 53 FE 01 AA AA"},
    {"init mode", {Kind::init_mode, 0x17, 0, 0, 0}, "55 55 55 17 E8 AA AA"},
    {"flash", {Kind::write_flash, 255, 0, 0, 0}, "56 56 56 FF 00 AA AA"},
    {"reset", {Kind::reset, 7, 0, 0, 0}, "57 57 57 07 F8 AA AA"},
};

TEST(MacTalk, RequestsAreTheManualsBytes) {
    for (const RequestExample& example : kRequests) {
        EXPECT_EQ(list(encode(example.request)), bytes(example.bytes)) << example.where;
    }
}

TEST(MacTalk, TheManualsBytesAreRequests) {
    for (const RequestExample& example : kRequests) {
        const auto got = requests_in(bytes(example.bytes));
        ASSERT_EQ(got.size(), 1u) << example.where;
        EXPECT_TRUE(got[0] == example.request) << example.where;
    }
}

struct ReplyExample {
    const char* where;
    std::uint8_t reg;
    std::uint32_t value;
    const char* bytes;
};

const ReplyExample kReplies[] = {
    {"001 §5.1 read 7", 7, 0x4711, "52 52 52 00 FF 07 F8 04 FB 11 EE 47 B8 00 FF 00 FF AA AA"},
    {"002 §5.7.3 read 5", 5, 600, "52 52 52 00 FF 05 FA 04 FB 58 A7 02 FD 00 FF 00 FF AA AA"},
    // 002 and 004 print register 5's number in the answer to register 3.
    {"002 §5.7.3 read 3", 3, 230'000, "52 52 52 00 FF 03 FC 04 FB 70 8F 82 7D 03 FC 00 FF AA AA"},
    {"002 §5.7.4 read 35", 35, 0x10, "52 52 52 00 FF 23 DC 04 FB 10 EF 00 FF 00 FF 00 FF AA AA"},
    {"002 §5.7.4 read 10", 10, 245'000, "52 52 52 00 FF 0A F5 04 FB 08 F7 BD 42 03 FC 00 FF AA AA"},
};

TEST(MacTalk, RepliesAreTheManualsBytes) {
    for (const ReplyExample& example : kReplies) {
        const std::array<std::uint8_t, 4> data = {
            static_cast<std::uint8_t>(example.value), static_cast<std::uint8_t>(example.value >> 8),
            static_cast<std::uint8_t>(example.value >> 16), static_cast<std::uint8_t>(example.value >> 24)};
        EXPECT_EQ(list(encode_registers(example.reg, data)), bytes(example.bytes)) << example.where;
    }
    EXPECT_EQ(list(encode_accept()), bytes("11 11 11"));
}

TEST(MacTalk, TheManualsBytesAreReplies) {
    for (const ReplyExample& example : kReplies) {
        const auto got = replies_in(bytes(example.bytes), Answer::registers, kReadBytes);
        ASSERT_EQ(got.size(), 1u) << example.where;
        EXPECT_EQ(got[0].reg, example.reg) << example.where;
        EXPECT_EQ(value_of(got[0]), example.value) << example.where;
    }
    EXPECT_EQ(replies_in(bytes("11 11 11"), Answer::accept, 0).size(), 1u);
}

TEST(MacTalk, SamplesComeWithoutARegister) {
    const std::array<std::uint8_t, 8> four = {1, 0, 2, 0, 3, 0, 0xFF, 0xFF};
    const ByteList expected =
        bytes("52 52 52 00 FF 08 F7 01 FE 00 FF 02 FD 00 FF 03 FC 00 FF FF 00 FF 00 AA AA");
    EXPECT_EQ(list(encode_samples(four)), expected);
    const auto got = replies_in(expected, Answer::samples, kSampleBytes);
    ASSERT_EQ(got.size(), 1u);
    EXPECT_EQ(got[0].reg, 0);
    EXPECT_TRUE(std::equal(four.begin(), four.end(), got[0].view().begin(), got[0].view().end()));
    EXPECT_TRUE(replies_in(expected, Answer::registers, kReadBytes).empty());
}

TEST(MacTalk, BlocksHaveSixtyFourBytes) {
    std::array<std::uint8_t, kBlockBytes> data{};
    for (std::size_t i = 0; i < data.size(); ++i) data[i] = static_cast<std::uint8_t>(3 * i + 0x50);
    const ByteList line = list(encode_registers(16, data));
    EXPECT_EQ(line.size(), 3u + 6 + 128 + 2);
    const auto got = replies_in(line, Answer::registers, kBlockBytes);
    ASSERT_EQ(got.size(), 1u);
    EXPECT_EQ(got[0].reg, 16);
    EXPECT_TRUE(std::equal(data.begin(), data.end(), got[0].view().begin(), got[0].view().end()));
}

TEST(MacTalk, AReplyHoldsSoMuchDataAndNoMore) {
    const ByteList most(kMaxReplyData, 0x51);
    const ByteList more(kMaxReplyData + 1, 0x51);
    EXPECT_EQ(list(encode_samples(most)).size(), 3 + 2 * (2 + kMaxReplyData) + 2);
    EXPECT_TRUE(list(encode_samples(more)).empty());
    EXPECT_FALSE(list(encode_registers(1, most)).empty());
    EXPECT_TRUE(list(encode_registers(1, more)).empty());
}

TEST(MacTalk, WhatIsAnsweredToWhat) {
    EXPECT_EQ(answer_to(Kind::read), Answer::registers);
    EXPECT_EQ(answer_to(Kind::read_block), Answer::registers);
    EXPECT_EQ(answer_to(Kind::write), Answer::accept);
    EXPECT_EQ(answer_to(Kind::read_samples), Answer::samples);
    EXPECT_EQ(answer_to(Kind::safe_mode), Answer::accept);
    EXPECT_EQ(answer_to(Kind::init_mode), Answer::accept);
    EXPECT_EQ(answer_to(Kind::write_flash), Answer::none);
    EXPECT_EQ(answer_to(Kind::reset), Answer::none);
}

TEST(MacTalk, WhatNoMessageCanSayIsEmpty) {
    EXPECT_EQ(encode({Kind::read, 1, 0, 0, 0}).size, 0u);
    EXPECT_EQ(encode({Kind::read_block, 1, 0, 0, 0}).size, 0u);
    EXPECT_EQ(encode({Kind::write, 1, 0, 2, 0}).size, 0u);
    for (int length = 0; length < 256; ++length) {
        if (length == 2 || length == 4) continue;
        EXPECT_EQ(encode({Kind::write, 1, 5, static_cast<std::uint8_t>(length), 0}).size, 0u) << length;
    }
    const std::array<std::uint8_t, kMaxReplyData + 1> too_much{};
    EXPECT_EQ(encode_registers(1, too_much).size, 0u);
    EXPECT_EQ(encode_registers(0, std::span(too_much).first<4>()).size, 0u);
    EXPECT_EQ(encode_samples(too_much).size, 0u);
}

// 002 and 004 print 05h,F6h: a byte and something that is not its inverse.
TEST(MacTalk, TheMisprintIsRefused) {
    EXPECT_TRUE(requests_in(bytes("50 50 50 08 F7 05 F6 AA AA")).empty());
    EXPECT_TRUE(replies_in(bytes("52 52 52 00 FF 05 F6 04 FB 58 A7 02 FD 00 FF 00 FF AA AA"),
                           Answer::registers, kReadBytes)
                    .empty());
}

TEST(MacTalk, OnlyTheKindsFrom50hTo57hAreRequests) {
    for (unsigned number = 0; number < 256; ++number) {
        const auto kind = static_cast<std::uint8_t>(number);
        const bool names_register = kind == 0x50 || kind == 0x51;
        const bool is_short = kind >= 0x53 && kind <= 0x57;
        EXPECT_EQ(requests_in({kind, kind, kind, 0x08, 0xF7, 0x05, 0xFA, 0xAA, 0xAA}).size(),
                  names_register ? 1U : 0U)
            << number;
        EXPECT_EQ(requests_in({kind, kind, kind, 0x08, 0xF7, 0xAA, 0xAA}).size(), is_short ? 1U : 0U)
            << number;
    }
}

TEST(MacTalk, RegisterNoughtIsNone) {
    EXPECT_TRUE(requests_in(bytes("50 50 50 08 F7 00 FF AA AA")).empty());
    EXPECT_TRUE(requests_in(bytes("52 52 52 08 F7 00 FF 02 FD 01 FE 00 FF AA AA")).empty());
    EXPECT_TRUE(replies_in(bytes("52 52 52 00 FF 00 FF 04 FB 01 FE 00 FF 00 FF 00 FF AA AA"),
                           Answer::registers, kReadBytes)
                    .empty());
}

const ByteList kGood = bytes("50 50 50 08 F7 05 FA AA AA");

void expect_next_is_understood(const ByteList& before, const char* what) {
    RequestDecoder decoder;
    EXPECT_TRUE(feed(decoder, before).empty()) << what;
    const auto got = feed(decoder, kGood);
    ASSERT_EQ(got.size(), 1u) << what;
    EXPECT_TRUE((got[0] == Request{Kind::read, 8, 5, 0, 0})) << what;
}

TEST(MacTalk, AWrongLengthIsNoWriteAndTheNextMessageIsUnderstood) {
    expect_next_is_understood(bytes("52 52 52 08 F7 05 FA 07 F8 01 FE 00 FF AA AA"), "length 7, two bytes");
    expect_next_is_understood(bytes("52 52 52 08 F7 05 FA 04 FB 01 FE 00 FF AA AA"), "length 4, two bytes");
    expect_next_is_understood(bytes("52 52 52 08 F7 05 FA 02 FD 01 FE 00 FF 00 FF 00 FF AA AA"),
                              "length 2, four bytes");
    expect_next_is_understood(bytes("52 52 52 08 F7 05 FA 00 FF AA AA"), "length 0");
    expect_next_is_understood(bytes("52 52 52 08 F7 05 FA 01 FE 01 FE AA AA"), "length 1");
    expect_next_is_understood(bytes("52 52 52 08 F7 05 FA FF 00 01 FE 00 FF AA AA"), "length 255");
}

TEST(MacTalk, NoiseBetweenMessagesCostsNothing) {
    for (const char* noise :
         {"00", "FF FF FF", "AA", "AA AA AA", "50", "50 50", "50 50 50", "50 50 50 50", "52", "52 52 52",
          "11 11 11", "57 57", "50 50 50 08", "52 52 52 08 F7 05", "54 54 54 50"}) {
        expect_next_is_understood(bytes(noise), noise);
    }
}

TEST(MacTalk, AMessageCutAnywhereIsDroppedAndTheNextIsUnderstood) {
    for (const RequestExample& example : kRequests) {
        const ByteList whole = bytes(example.bytes);
        for (std::size_t cut = 0; cut < whole.size(); ++cut) {
            expect_next_is_understood({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(cut)},
                                      example.where);
        }
    }
}

TEST(MacTalk, RepliesOfOtherUnitsAreNoRequestsToAnyUnit) {
    for (const ReplyExample& example : kReplies) {
        for (const Request& request : requests_in(bytes(example.bytes)))
            EXPECT_EQ(request.address, kMasterAddress) << example.where;
    }
    expect_next_is_understood(bytes("11 11 11"), "accept");
    std::array<std::uint8_t, kBlockBytes> data{};
    data.fill(0x52);
    expect_next_is_understood(list(encode_registers(9, data)), "block");
    expect_next_is_understood(list(encode_samples(std::span(data).first<8>())), "samples");
}

TEST(MacTalk, PipelinedMessagesAreAllUnderstood) {
    ByteList line;
    std::size_t count = 0;
    for (int round = 0; round < 3; ++round) {
        for (const RequestExample& example : kRequests) {
            line = line + bytes(example.bytes);
            ++count;
        }
    }
    EXPECT_EQ(requests_in(line).size(), count);
}

TEST(MacTalk, AnAbandonedMessageIsForgotten) {
    RequestDecoder decoder;
    EXPECT_TRUE(feed(decoder, bytes("50 50 50 08 F7 05 FA AA")).empty());
    EXPECT_TRUE(decoder.in_message());
    decoder.abandon();
    EXPECT_FALSE(decoder.in_message());
    EXPECT_TRUE(feed(decoder, bytes("AA")).empty());
    EXPECT_EQ(feed(decoder, kGood).size(), 1u);
}

TEST(MacTalk, OnlyTheExpectedAnswerIsReported) {
    const ByteList value = bytes(kReplies[0].bytes);
    EXPECT_TRUE(replies_in(value, Answer::none, 0).empty());
    EXPECT_TRUE(replies_in(value, Answer::accept, 0).empty());
    EXPECT_TRUE(replies_in(value, Answer::registers, kBlockBytes).empty());
    EXPECT_TRUE(replies_in(bytes("11 11 11"), Answer::registers, kReadBytes).empty());
    // A write to unit 8 heard on the same line is no reply.
    EXPECT_TRUE(replies_in(bytes("52 52 52 08 F7 05 FA 04 FB 58 A7 02 FD 00 FF 00 FF AA AA"),
                           Answer::registers, kReadBytes)
                    .empty());
    // A reply begins as a write does, and with nothing else.
    EXPECT_TRUE(replies_in(bytes("50 50 50 00 FF 05 FA 04 FB 58 A7 02 FD 00 FF 00 FF AA AA"),
                           Answer::registers, kReadBytes)
                    .empty());
    const auto after_noise = replies_in(bytes("52 52 00 11 AA") + value, Answer::registers, kReadBytes);
    EXPECT_EQ(after_noise.size(), 1u);
}

}  // namespace
}  // namespace nplc::protocol::mactalk
