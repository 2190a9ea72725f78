#include "protocol/fastmac.h"

#include <gtest/gtest.h>

#include <array>

namespace nplc::protocol::fastmac {
namespace {

constexpr Command select(Mode mode, Group group, std::uint8_t index) {
    return {mode, group, index, 0};
}

constexpr Command order(std::uint8_t number) {
    return {Mode::command, Group::p, 1, number};
}

struct Line {
    std::uint8_t byte;
    Command command;
};

// The moves of 001 §5.2.1.5 by the list of §5.2.1.4, each byte put together by hand:
//   E0 = 1 11 00000   63 = 0 11 00011   95 = 1 00 101 01   13 = 0 00 100 11   8B = 1 00 01 011
//   45 = 0 10 00 101  C6 = 1 10 00 110  4A = 0 10 01 010   C4 = 1 10 00 100
constexpr std::array<Line, 9> kExample{{{0xE0, order(0)},
                                        {0x63, order(3)},
                                        {0x95, select(Mode::init, Group::t, 2)},
                                        {0x13, select(Mode::init, Group::a, 4)},
                                        {0x8B, select(Mode::init, Group::v, 4)},
                                        {0x45, select(Mode::position, Group::p, 6)},
                                        {0xC6, select(Mode::position, Group::p, 7)},
                                        {0x4A, select(Mode::position, Group::v, 3)},
                                        {0xC4, select(Mode::position, Group::p, 5)}}};

TEST(FastMac, ExampleMovesAreDecoded) {
    for (const Line& line : kExample) EXPECT_EQ(decode_command(line.byte), line.command) << int{line.byte};
}

TEST(FastMac, ExampleMovesAreEncodedWithAlternatingToggle) {
    bool toggle = true;
    for (const Line& line : kExample) {
        EXPECT_EQ(with_toggle(encode_command(line.command), toggle), line.byte);
        toggle = !toggle;
    }
}

// 001 §5.2.1.4: first and last register of each group, in init mode.
TEST(FastMac, FormatListEnds) {
    EXPECT_EQ(decode_command(0b0'00'00'000), select(Mode::init, Group::p, 1));
    EXPECT_EQ(decode_command(0b0'00'00'111), select(Mode::init, Group::p, 8));
    EXPECT_EQ(decode_command(0b0'00'01'000), select(Mode::init, Group::v, 1));
    EXPECT_EQ(decode_command(0b0'00'01'111), select(Mode::init, Group::v, 8));
    EXPECT_EQ(decode_command(0b0'00'100'00), select(Mode::init, Group::a, 1));
    EXPECT_EQ(decode_command(0b0'00'100'11), select(Mode::init, Group::a, 4));
    EXPECT_EQ(decode_command(0b0'00'101'00), select(Mode::init, Group::t, 1));
    EXPECT_EQ(decode_command(0b0'00'101'11), select(Mode::init, Group::t, 4));
    EXPECT_EQ(decode_command(0b0'00'110'00), select(Mode::init, Group::l, 1));
    EXPECT_EQ(decode_command(0b0'00'110'11), select(Mode::init, Group::l, 4));
    EXPECT_EQ(decode_command(0b0'00'111'00), select(Mode::init, Group::z, 1));
    EXPECT_EQ(decode_command(0b0'00'111'11), select(Mode::init, Group::z, 4));
}

TEST(FastMac, ModeBits) {
    EXPECT_EQ(decode_command(0b0'01'00'000).mode, Mode::velocity);
    EXPECT_EQ(decode_command(0b0'10'00'000).mode, Mode::position);
    EXPECT_EQ(decode_command(0b0'11'00'000).mode, Mode::command);
    EXPECT_EQ(encode_command(select(Mode::velocity, Group::v, 2)), 0b0'01'01'001);
    EXPECT_EQ(encode_command(select(Mode::position, Group::z, 3)), 0b0'10'111'10);
}

// 001 §5.2.1.4: 6xh and 7xh are the command numbers 00h to 1Fh.
TEST(FastMac, CommandNumbers) {
    EXPECT_EQ(command_byte(Number::nop), 0x60);
    EXPECT_EQ(command_byte(Number::reset_error), 0x61);
    EXPECT_EQ(command_byte(Number::clear_p_soll), 0x62);
    EXPECT_EQ(command_byte(Number::clear_p_ist), 0x63);
    EXPECT_EQ(command_byte(Number::clear_p_fnc), 0x64);
    EXPECT_EQ(command_byte(Number::clear_v_soll), 0x65);
    EXPECT_EQ(command_byte(Number::clear_t_soll), 0x66);
    EXPECT_EQ(command_byte(Number::clear_in_pos), 0x67);
    EXPECT_EQ(command_byte(Number::move_p7_by_p_fnc), 0x68);
    EXPECT_EQ(command_byte(Number::move_p8_by_p_fnc), 0x69);
    EXPECT_EQ(command_byte(Number::rapid_communication), 0x6A);
    EXPECT_EQ(command_byte(Number::safe_communication), 0x6B);
    EXPECT_EQ(command_byte(Number::use_set_1), 0x6C);
    EXPECT_EQ(command_byte(Number::use_set_2), 0x6D);
    EXPECT_EQ(command_byte(Number::use_set_3), 0x6E);
    EXPECT_EQ(command_byte(Number::use_set_4), 0x6F);
    EXPECT_EQ(command_byte(Number::home), 0x70);
    EXPECT_EQ(command_byte(Number::move_p7_by_p_soll), 0x71);
    EXPECT_EQ(command_byte(Number::move_p8_by_p_soll), 0x72);
    EXPECT_EQ(command_byte(Number::transmit_slowly), 0x73);
    EXPECT_EQ(command_byte(Number::positions_absolute), 0x74);
    EXPECT_EQ(command_byte(Number::positions_relative_p_soll), 0x75);
    EXPECT_EQ(command_byte(Number::positions_relative_p_fnc), 0x76);
    EXPECT_EQ(command_byte(Number::transmit_address), 0x7D);
    EXPECT_EQ(command_byte(Number::use_fastmac), 0x7E);
    EXPECT_EQ(command_byte(Number::use_flexmac), 0x7F);
    EXPECT_EQ(decode_command(0x7F).number, 0x1F);
}

TEST(FastMac, All128CommandsComeBack) {
    for (int byte = 0; byte < 128; ++byte) {
        const auto b = static_cast<std::uint8_t>(byte);
        EXPECT_EQ(encode_command(decode_command(b)), b);
        EXPECT_EQ(decode_command(static_cast<std::uint8_t>(b | kToggle)), decode_command(b));
        EXPECT_EQ(encode_command(decode_command(b, RegisterCode::older_example), RegisterCode::older_example),
                  b);
    }
}

TEST(FastMac, FieldsOutOfRangeAreCut) {
    EXPECT_EQ(encode_command(select(Mode::init, Group::a, 5)),
              0x10);  // 5 - 1 = 100 binary, two bits stay: A1
    EXPECT_EQ(encode_command(select(Mode::init, Group::p, 9)),
              0x00);                               // 9 - 1 = 1000 binary, three bits stay: P1
    EXPECT_EQ(encode_command(order(0x20)), 0x60);  // 100000 binary, five bits stay
}

// 001 §5.2.1.5 as printed: 03 A4, 93 V4, 5D P6, DE P7, 52 V3, DC P5 (its 81h for T2 fits no code).
TEST(FastMac, OlderCodeReadsTheExampleAsPrinted) {
    const auto decode = [](std::uint8_t byte) { return decode_command(byte, RegisterCode::older_example); };
    EXPECT_EQ(decode(0x03), select(Mode::init, Group::a, 4));
    EXPECT_EQ(decode(0x93), select(Mode::init, Group::v, 4));
    EXPECT_EQ(decode(0x5D), select(Mode::position, Group::p, 6));
    EXPECT_EQ(decode(0xDE), select(Mode::position, Group::p, 7));
    EXPECT_EQ(decode(0x52), select(Mode::position, Group::v, 3));
    EXPECT_EQ(decode(0xDC), select(Mode::position, Group::p, 5));
    EXPECT_EQ(encode_command(select(Mode::position, Group::p, 6), RegisterCode::older_example), 0x5D);
    EXPECT_EQ(encode_command(select(Mode::init, Group::v, 4), RegisterCode::older_example), 0x13);
    EXPECT_EQ(encode_command(select(Mode::init, Group::a, 4), RegisterCode::older_example), 0x03);
}

TEST(FastMac, AGroupThatThereIsNotLeavesTheModeAlone) {
    EXPECT_EQ(encode_command(select(Mode::position, static_cast<Group>(6), 8)), 0x40);
}

// 001 §5.2.1.6, one bit at a time.
TEST(FastMac, StatusBits) {
    EXPECT_EQ(decode_status(0x80), Status{.toggle = true});
    EXPECT_EQ(decode_status(0x40), Status{.decelerating = true});
    EXPECT_EQ(decode_status(0x20), Status{.accelerating = true});
    EXPECT_EQ(decode_status(0x10), Status{.in_position = true});
    EXPECT_EQ(decode_status(0x08), Status{.flexmac = true});
    EXPECT_EQ(decode_status(0x04), Status{.framing_error = true});
    EXPECT_EQ(decode_status(0x02), Status{.available = true});
    EXPECT_EQ(decode_status(0x01), Status{.error = true});
    EXPECT_EQ(decode_status(0x00), Status{});
    EXPECT_EQ(encode_status({.toggle = true, .in_position = true, .error = true}), 0x91);
    EXPECT_EQ(encode_status({.decelerating = true, .flexmac = true, .available = true}), 0x4A);
    EXPECT_EQ(encode_status({.accelerating = true, .framing_error = true}), 0x24);
}

TEST(FastMac, All256StatusBytesComeBack) {
    for (int byte = 0; byte < 256; ++byte) {
        const auto b = static_cast<std::uint8_t>(byte);
        EXPECT_EQ(encode_status(decode_status(b)), b);
    }
}

}  // namespace
}  // namespace nplc::protocol::fastmac
