#include "flexmac_bytes.h"

#include <gtest/gtest.h>

namespace nplc::protocol::flexmac {
namespace {

void expect_one(const ByteList& bytes, const Message& message) {
    const auto messages = messages_in(bytes);
    ASSERT_EQ(messages.size(), 1u) << hex(bytes);
    EXPECT_TRUE(messages[0] == message) << hex(bytes);
}

// 001 §5.2.2, register 5 and, as printed, register 9.
TEST(FlexMacRequest, WriteVSollInThreeForms) {
    expect_one({0x63, 0x63, 0x63, 0x47, 0xB8, 0x05, 0xFA}, {.target = 3, .value = 0x0547});
    expect_one({0x60, 0x60, 0x60, 0x05, 0xFA, 0x47, 0xB8, 0x05, 0xFA},
               {.level = Level::reg, .target = 5, .value = 0x0547});
    expect_one({0x60, 0x60, 0x60, 0x09, 0xF6, 0x47, 0xB8, 0x05, 0xFA},
               {.level = Level::reg, .target = 9, .value = 0x0547});
    expect_one({0x60, 0x60, 0x60, 0x00, 0xFF, 0x12, 0xED, 0x04, 0xFB, 0x47, 0xB8, 0x05, 0xFA},
               {.level = Level::address, .target = 0x0412, .value = 0x0547});
}

TEST(FlexMacRequest, ReadPIstInThreeForms) {
    expect_one({0xF3, 0xF3, 0xF3}, {.read = true, .longword = true, .target = 3});
    expect_one({0xF0, 0xF0, 0xF0, 0x0A, 0xF5},
               {.read = true, .longword = true, .level = Level::reg, .target = 10});
    expect_one({0xF0, 0xF0, 0xF0, 0x0E, 0xF1},
               {.read = true, .longword = true, .level = Level::reg, .target = 14});
    expect_one({0xF0, 0xF0, 0xF0, 0x00, 0xFF, 0x1C, 0xE3, 0x04, 0xFB},
               {.read = true, .longword = true, .level = Level::address, .target = 0x041C});
}

TEST(FlexMacRequest, ProtocolCommands) {
    expect_one({0x7E, 0x7E, 0x7E}, kUseFastMac);
    expect_one({0x7F, 0x7F, 0x7F}, kUseFlexMac);
    EXPECT_TRUE(messages_in({0xFE, 0xFE, 0xFE}).empty());
    EXPECT_TRUE(messages_in({0xFF, 0xFF, 0xFF}).empty());
}

// The header's bit 7 decides the width, not the register: V_SOLL, a word, as longword; P_SOLL, a longword, as
// word.
TEST(FlexMacRequest, WidthIsTheHeaders) {
    expect_one({0xE3, 0xE3, 0xE3, 0x78, 0x87, 0x56, 0xA9, 0x34, 0xCB, 0x12, 0xED},
               {.longword = true, .target = 3, .value = 0x12345678});
    expect_one({0x62, 0x62, 0x62, 0x01, 0xFE, 0x80, 0x7F}, {.target = 2, .value = 0x8001});
    expect_one({0x73, 0x73, 0x73}, {.read = true, .target = 3});
    expect_one({0xF4, 0xF4, 0xF4}, {.read = true, .longword = true, .target = 4});
    expect_one({0xEF, 0xEF, 0xEF, 0x01, 0xFE, 0x00, 0xFF, 0x00, 0xFF, 0x00, 0xFF},
               {.longword = true, .target = 15, .value = 1});
}

TEST(FlexMacRequest, MessagesFollowEachOther) {
    const auto messages = messages_in({0x74, 0x74, 0x74, 0x74, 0x74, 0x74, 0x63, 0x63, 0x63, 0x47,
                                       0xB8, 0x05, 0xFA, 0x63, 0x63, 0x63, 0x00, 0xFF, 0x00, 0xFF});
    ASSERT_EQ(messages.size(), 4u);
    EXPECT_TRUE((messages[1] == Message{.read = true, .target = 4}));
    EXPECT_TRUE((messages[2] == Message{.target = 3, .value = 0x0547}));
    EXPECT_TRUE((messages[3] == Message{.target = 3, .value = 0}));
}

TEST(FlexMacRequest, OnlyHeaderBytesBeginAMessage) {
    for (int byte = 0; byte < 256; ++byte) {
        RequestDecoder decoder;
        decoder.receive(static_cast<std::uint8_t>(byte));
        const bool bits_set = (byte / 32) % 4 == 3;
        EXPECT_EQ(decoder.in_message(), bits_set && byte != 0xFE && byte != 0xFF) << byte;
    }
}

TEST(FlexMacRequest, ByteThatBrokeAHeaderBeginsTheNext) {
    expect_one({0x63, 0x74, 0x74, 0x74}, {.read = true, .target = 4});
    expect_one({0x63, 0x63, 0x74, 0x74, 0x74}, {.read = true, .target = 4});
    expect_one({0x74, 0x74, 0x63, 0x63, 0x63, 0x47, 0xB8, 0x05, 0xFA}, {.target = 3, .value = 0x0547});
    EXPECT_TRUE(messages_in({0x74, 0x74, 0x00, 0x74, 0x74}).empty());
}

TEST(FlexMacRequest, ByteThatBrokeAnInverseBeginsTheNext) {
    expect_one({0x63, 0x63, 0x63, 0x47, 0x74, 0x74, 0x74}, {.read = true, .target = 4});
    expect_one({0x60, 0x60, 0x60, 0x05, 0x7E, 0x7E, 0x7E}, kUseFastMac);
}

TEST(FlexMacRequest, PauseDropsTheMessage) {
    RequestDecoder decoder;
    feed(decoder, {0x63, 0x63, 0x63, 0x47, 0xB8});
    EXPECT_TRUE(decoder.in_message());
    decoder.abandon();
    EXPECT_FALSE(decoder.in_message());
    EXPECT_TRUE(feed(decoder, {0x05, 0xFA}).empty());
    EXPECT_EQ(feed(decoder, {0x63, 0x63, 0x63, 0x47, 0xB8, 0x05, 0xFA}).size(), 1u);
    EXPECT_FALSE(decoder.in_message());
}

// V_SOLL = 9C63h in index form, header byte lost: the first data byte takes its place and everything shifts.
TEST(FlexMacRequest, LostHeaderByteThatDataReplacesGivesNothing) {
    RequestDecoder decoder;
    EXPECT_TRUE(feed(decoder, {0x63, 0x63, 0x63, 0x9C, 0x63, 0x9C}).empty());
    decoder.abandon();
    EXPECT_EQ(feed(decoder, {0x63, 0x63, 0x63, 0x63, 0x9C, 0x63, 0x9C}).size(), 1u);
}

// Why a master pauses: without the pause the next message's first byte completes the shifted one.
TEST(FlexMacRequest, LostHeaderByteWithoutPauseCanGiveAWrongValue) {
    RequestDecoder decoder;
    feed(decoder, {0x63, 0x63, 0x63, 0x9C, 0x63, 0x9C});
    const auto messages = feed(decoder, {0x63, 0x63, 0x63, 0x47, 0xB8, 0x05, 0xFA});
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_TRUE((messages[0] == Message{.target = 3, .value = 0x9C9C}));
}

}  // namespace
}  // namespace nplc::protocol::flexmac
