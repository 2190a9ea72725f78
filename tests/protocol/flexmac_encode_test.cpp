#include "flexmac_bytes.h"

#include <gtest/gtest.h>

namespace nplc::protocol::flexmac {
namespace {

ByteList request(const Message& message) {
    return list(encode(message));
}

// 001 §5.2.2: V_SOLL = 0547h. ~47 = B8, ~05 = FA; the manual's register number 9 is 5 in §3.2.
TEST(FlexMacEncode, WriteVSollInThreeForms) {
    EXPECT_EQ(request({.target = 3, .value = 0x0547}), (ByteList{0x63, 0x63, 0x63, 0x47, 0xB8, 0x05, 0xFA}));
    EXPECT_EQ(request({.level = Level::reg, .target = 5, .value = 0x0547}),
              (ByteList{0x60, 0x60, 0x60, 0x05, 0xFA, 0x47, 0xB8, 0x05, 0xFA}));
    EXPECT_EQ(request({.level = Level::reg, .target = 9, .value = 0x0547}),
              (ByteList{0x60, 0x60, 0x60, 0x09, 0xF6, 0x47, 0xB8, 0x05, 0xFA}));
    EXPECT_EQ(request({.level = Level::address, .target = 0x0412, .value = 0x0547}),
              (ByteList{0x60, 0x60, 0x60, 0x00, 0xFF, 0x12, 0xED, 0x04, 0xFB, 0x47, 0xB8, 0x05, 0xFA}));
}

// 001 §5.2.2: P_IST, longword; the manual's register number 14 is 10 in §3.2, ~0A = F5.
TEST(FlexMacEncode, ReadPIstInThreeForms) {
    EXPECT_EQ(request({.read = true, .longword = true, .target = 3}), (ByteList{0xF3, 0xF3, 0xF3}));
    EXPECT_EQ(request({.read = true, .longword = true, .level = Level::reg, .target = 10}),
              (ByteList{0xF0, 0xF0, 0xF0, 0x0A, 0xF5}));
    EXPECT_EQ(request({.read = true, .longword = true, .level = Level::reg, .target = 14}),
              (ByteList{0xF0, 0xF0, 0xF0, 0x0E, 0xF1}));
    EXPECT_EQ(request({.read = true, .longword = true, .level = Level::address, .target = 0x041C}),
              (ByteList{0xF0, 0xF0, 0xF0, 0x00, 0xFF, 0x1C, 0xE3, 0x04, 0xFB}));
}

// P_SOLL = -2 = FFFFFFFEh; ~FE = 01, ~FF = 00. Header E2 = 1 11 0 0010.
TEST(FlexMacEncode, WriteLongword) {
    EXPECT_EQ(request({.longword = true, .target = 2, .value = 0xFFFFFFFE}),
              (ByteList{0xE2, 0xE2, 0xE2, 0xFE, 0x01, 0xFF, 0x00, 0xFF, 0x00, 0xFF, 0x00}));
    EXPECT_EQ(request({.longword = true, .level = Level::address, .target = 0x040E, .value = 0x12345678}),
              (ByteList{0xE0, 0xE0, 0xE0, 0x00, 0xFF, 0x0E, 0xF1, 0x04, 0xFB, 0x78, 0x87, 0x56, 0xA9, 0x34,
                        0xCB, 0x12, 0xED}));
}

TEST(FlexMacEncode, ProtocolCommands) {
    EXPECT_EQ(request(kUseFastMac), (ByteList{0x7E, 0x7E, 0x7E}));
    EXPECT_EQ(request(kUseFlexMac), (ByteList{0x7F, 0x7F, 0x7F}));
    EXPECT_TRUE(is_protocol_command(kUseFastMac));
    EXPECT_TRUE(is_protocol_command(kUseFlexMac));
    EXPECT_FALSE(is_protocol_command({.read = true, .target = 13}));
    EXPECT_FALSE(is_protocol_command({.target = 14}));
    EXPECT_FALSE(is_protocol_command({.read = true, .level = Level::reg, .target = 14}));
}

TEST(FlexMacEncode, WordWriteSendsTheLowWord) {
    EXPECT_EQ(request({.target = 3, .value = 0xFFFFFAB9}),
              (ByteList{0x63, 0x63, 0x63, 0xB9, 0x46, 0xFA, 0x05}));
}

TEST(FlexMacEncode, WhatNoHeaderCanSayIsEmpty) {
    EXPECT_EQ(encode({.target = 0}).size, 0u);
    EXPECT_EQ(encode({.target = 16}).size, 0u);
    EXPECT_EQ(encode({.read = true, .target = 0}).size, 0u);
    EXPECT_EQ(encode({.level = Level::reg, .target = 0}).size, 0u);
    EXPECT_EQ(encode({.level = Level::reg, .target = 256}).size, 0u);
    EXPECT_EQ(encode({.read = true, .longword = true, .target = 14}).size, 0u);
    EXPECT_EQ(encode({.read = true, .longword = true, .target = 15}).size, 0u);
    EXPECT_EQ(encode_reply({.read = true, .target = 0}, 1).size, 0u);
}

// The header and block again, then the data. V_IST (read index 4) = -100 = FF9Ch, P_IST = 00023456h.
TEST(FlexMacEncode, Replies) {
    EXPECT_EQ(list(encode_reply({.read = true, .target = 4}, 0xFF9C)),
              (ByteList{0x74, 0x74, 0x74, 0x9C, 0x63, 0xFF, 0x00}));
    EXPECT_EQ(
        list(encode_reply({.read = true, .longword = true, .level = Level::reg, .target = 10}, 0x00023456)),
        (ByteList{0xF0, 0xF0, 0xF0, 0x0A, 0xF5, 0x56, 0xA9, 0x34, 0xCB, 0x02, 0xFD, 0x00, 0xFF}));
    EXPECT_EQ(list(encode_reply({.read = true, .level = Level::address, .target = 0x0412}, 0x0547)),
              (ByteList{0x70, 0x70, 0x70, 0x00, 0xFF, 0x12, 0xED, 0x04, 0xFB, 0x47, 0xB8, 0x05, 0xFA}));
}

TEST(FlexMacEncode, WritesAndProtocolCommandsHaveNoReply) {
    EXPECT_EQ(encode_reply({.target = 3, .value = 1}, 1).size, 0u);
    EXPECT_EQ(encode_reply(kUseFastMac, 1).size, 0u);
    EXPECT_EQ(encode_reply(kUseFlexMac, 1).size, 0u);
}

// 001 §5.2.2's tables, names looked up in §3.2.
TEST(FlexMacTables, WriteIndices) {
    const ByteList registers{36, 3, 5, 6, 7, 13, 33, 49, 51, 65, 66, 73, 74, 81, 82};
    for (std::size_t i = 0; i < registers.size(); ++i) {
        EXPECT_EQ(register_of_write_index(static_cast<std::uint8_t>(i + 1)), registers[i]);
    }
    EXPECT_EQ(register_of_write_index(0), 0);
    EXPECT_EQ(register_of_write_index(16), 0);
    EXPECT_EQ(register_of_write_index(255), 0);
}

TEST(FlexMacTables, ReadIndices) {
    const ByteList registers{36, 8, 10, 12, 120, 122, 131, 121, 16, 18, 20, 24, 35};
    for (std::size_t i = 0; i < registers.size(); ++i) {
        EXPECT_EQ(register_of_read_index(static_cast<std::uint8_t>(i + 1)), registers[i]);
    }
    for (const std::uint8_t index : ByteList{0, 14, 15, 16, 255}) EXPECT_EQ(register_of_read_index(index), 0);
}

// 001 §5.2.2: 0412h is V_SOLL (5), 041Ch is P_IST (10).
TEST(FlexMacTables, Addresses) {
    EXPECT_EQ(address_of_register(5), 0x0412);
    EXPECT_EQ(address_of_register(10), 0x041C);
    EXPECT_EQ(register_of_address(0x0412), std::optional<std::uint8_t>(5));
    EXPECT_EQ(register_of_address(0x041C), std::optional<std::uint8_t>(10));
    EXPECT_EQ(register_of_address(0x040A), std::optional<std::uint8_t>(1));
    EXPECT_EQ(register_of_address(0x0606), std::optional<std::uint8_t>(255));  // 0408h + 2 x 255 = 0606h
    for (const std::uint16_t none :
         std::vector<std::uint16_t>{0x0000, 0x0408, 0x0409, 0x0413, 0x0607, 0x0608, 0xFFFF}) {
        EXPECT_EQ(register_of_address(none), std::nullopt) << none;
    }
}

}  // namespace
}  // namespace nplc::protocol::flexmac
