#include "flexmac_bytes.h"

#include <gtest/gtest.h>

namespace nplc::protocol::flexmac {
namespace {

const ByteList kVIst{0x74, 0x74, 0x74, 0x9C, 0x63, 0xFF, 0x00};  // V_IST = -100 = FF9Ch

ByteList join(std::initializer_list<ByteList> parts) {
    ByteList all;
    for (const ByteList& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

Heard hear(const ByteList& bytes) {
    ReplyDecoder decoder;
    return feed(decoder, bytes);
}

TEST(FlexMacReply, StatusBytesPassAtOnce) {
    for (int byte = 0; byte < 256; ++byte) {
        const bool both_bits = (byte / 32) % 4 == 3;
        const auto b = static_cast<std::uint8_t>(byte);
        EXPECT_EQ(hear({b}).status, both_bits ? ByteList{} : ByteList{b});
    }
}

TEST(FlexMacReply, RepliesOfAllForms) {
    const Heard word = hear(join({{0x10, 0x10}, kVIst, {0x90, 0x90}}));
    EXPECT_EQ(word.status, (ByteList{0x10, 0x10, 0x90, 0x90}));
    ASSERT_EQ(word.replies.size(), 1u);
    EXPECT_TRUE((word.replies[0] == Message{.read = true, .target = 4, .value = 0xFF9C}));

    const Heard reg =
        hear({0xF0, 0xF0, 0xF0, 0x0A, 0xF5, 0x56, 0xA9, 0x34, 0xCB, 0x02, 0xFD, 0x00, 0xFF, 0x18});
    EXPECT_EQ(reg.status, ByteList{0x18});
    ASSERT_EQ(reg.replies.size(), 1u);
    EXPECT_TRUE(
        (reg.replies[0] ==
         Message{.read = true, .longword = true, .level = Level::reg, .target = 10, .value = 0x00023456}));

    const Heard address =
        hear({0x70, 0x70, 0x70, 0x00, 0xFF, 0x12, 0xED, 0x04, 0xFB, 0x47, 0xB8, 0x05, 0xFA});
    ASSERT_EQ(address.replies.size(), 1u);
    EXPECT_TRUE((address.replies[0] ==
                 Message{.read = true, .level = Level::address, .target = 0x0412, .value = 0x0547}));
}

TEST(FlexMacReply, RepliesFollowEachOther) {
    EXPECT_EQ(hear(join({kVIst, kVIst})).replies.size(), 2u);
}

// MYADDR in place of one status byte (001 §5.2.1.4, command 1Dh), with bits 6..5 = 11 or not.
TEST(FlexMacReply, LoneOddByteCostsTheTwoBytesAfterIt) {
    for (const std::uint8_t odd : ByteList{0x60, 0x6F, 0x70, 0x7D, 0x7E, 0x7F, 0xE2, 0xF0, 0xFE, 0xFF}) {
        const Heard heard = hear({0x10, odd, 0x10, 0x10, 0x10, 0x10});
        EXPECT_EQ(heard.status, (ByteList{0x10, 0x10, 0x10})) << int{odd};
        EXPECT_TRUE(heard.replies.empty());
    }
    EXPECT_EQ(hear({0x10, 0x05, 0x10}).status, (ByteList{0x10, 0x05, 0x10}));
}

TEST(FlexMacReply, WriteHeadersAndProtocolCommandsBeginNoReply) {
    for (const std::uint8_t header : ByteList{0x63, 0x7E, 0x7F, 0xE2, 0xFE, 0xFF}) {
        EXPECT_TRUE(hear({header, header, header, 0x47, 0xB8, 0x05, 0xFA}).replies.empty()) << int{header};
    }
}

// A header whose reply is cut off before its data, and one with a wrong inverse.
TEST(FlexMacReply, BrokenReplyIsDropped) {
    const Heard cut = hear({0x74, 0x74, 0x74, 0x10, 0x10, 0x10, 0x10, 0x10});
    EXPECT_TRUE(cut.replies.empty());
    // 10 stands as data, 10 is a wrong inverse and the first of three equal, two more make it sure, one
    // follows.
    EXPECT_EQ(cut.status, (ByteList{0x10, 0x10}));
    const Heard wrong = hear({0x74, 0x74, 0x74, 0x9C, 0x62, 0xFF, 0x00, 0x10, 0x10, 0x10, 0x10});
    EXPECT_TRUE(wrong.replies.empty());
    EXPECT_EQ(wrong.status, (ByteList{0x10, 0x10}));
}

// Every value whose low byte's inverse equals its high byte, as F5 0A 0A F5: were the reply's rest taken for
// status bytes, two equal ones in a row would be valid.
TEST(FlexMacReply, BrokenReplyNeverShowsTwoEqualStatusBytes) {
    const ByteList status{0x90, 0x90, 0x90, 0x90};
    for (int low = 0; low < 256; ++low) {
        const auto value = static_cast<std::uint32_t>(low | (~low & 0xFF) << 8);
        const ByteList reply = list(encode_reply({.read = true, .target = 4}, value));
        for (std::size_t place = 0; place < reply.size(); ++place) {
            for (int change = 0; change < 256; ++change) {
                ByteList bytes = reply;
                if (change == 0) {
                    bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(place));
                } else {
                    bytes[place] = static_cast<std::uint8_t>(bytes[place] ^ change);
                }
                const Heard heard = hear(join({status, bytes, status, status}));
                for (std::size_t i = 1; i < heard.status.size(); ++i) {
                    if (heard.status[i] != heard.status[i - 1]) continue;
                    ASSERT_EQ(heard.status[i], 0x90) << hex(reply) << " as " << hex(bytes);
                }
                if (change == 0) continue;
                ASSERT_TRUE(heard.replies.empty()) << hex(reply) << " as " << hex(bytes);
            }
        }
    }
}

TEST(FlexMacReply, EverySingleDamagedByteIsRefused) {
    for (const Message& request : telling_messages()) {
        if (!request.read || is_protocol_command(request)) continue;
        for (const std::uint32_t value : {0u, 0xFFFFFFFFu, 0x70F08F0Fu}) {
            const ByteList whole = list(encode_reply(request, value));
            ASSERT_EQ(hear(whole).replies.size(), 1u) << hex(whole);
            for (std::size_t place = 0; place < whole.size(); ++place) {
                for (int change = 1; change < 256; ++change) {
                    ByteList bytes = whole;
                    bytes[place] = static_cast<std::uint8_t>(bytes[place] ^ change);
                    const Heard heard = hear(join({{0x18, 0x18}, bytes, {0x18, 0x18, 0x18, 0x18, 0x18}}));
                    ASSERT_TRUE(heard.replies.empty()) << hex(whole) << " as " << hex(bytes);
                    ASSERT_EQ(heard.status.back(), 0x18) << hex(whole) << " as " << hex(bytes);
                }
            }
        }
    }
}

TEST(FlexMacReply, FramingErrorInAReplyRaisesDoubt) {
    ReplyDecoder decoder;
    EXPECT_TRUE(feed(decoder, {0x74, 0x74, 0x74, 0xF5}).status.empty());
    decoder.abandon();
    EXPECT_TRUE(feed(decoder, {0x0A, 0x0A, 0xF5}).status.empty());
    EXPECT_EQ(feed(decoder, {0x10, 0x10, 0x10}).status, ByteList{0x10});
    decoder.abandon();  // between status bytes: nothing to lose
    EXPECT_EQ(feed(decoder, {0x11}).status, ByteList{0x11});
}

/// Three equal ones end the doubt, with nothing between them.
TEST(FlexMacReply, WhatComesBetweenBeginsTheRunAnew) {
    for (const std::uint8_t between : ByteList{0xFF, 0x74, 0x11}) {
        ReplyDecoder decoder;
        EXPECT_TRUE(feed(decoder, {0xFF, 0x10, 0x10, between, 0x10, 0x10}).status.empty()) << int{between};
        EXPECT_EQ(feed(decoder, {0x10}).status, ByteList{0x10}) << int{between};
    }
}

TEST(FlexMacReply, WholeReplyEndsDoubt) {
    EXPECT_EQ(hear(join({{0xFF}, kVIst, {0x10}})).status, ByteList{0x10});
}

// What stays undetected: 0032h ends in 00 FF. The 00h is lost, FFh is taken for data, and a status byte 00h
// for its inverse: FF32h. A master that must be sure reads twice.
TEST(FlexMacReply, StatusByteCanStandInForALostLastByte) {
    const Heard heard = hear({0x00, 0x00, 0x74, 0x74, 0x74, 0x32, 0xCD, 0xFF, 0x00, 0x00});
    ASSERT_EQ(heard.replies.size(), 1u);
    EXPECT_EQ(heard.replies[0].value, 0xFF32u);
    EXPECT_EQ(heard.status, (ByteList{0x00, 0x00, 0x00}));
}

}  // namespace
}  // namespace nplc::protocol::flexmac
