#include "motor_bench.h"

namespace nplc::sim {
namespace {

using enum registers::Number;

MotorBench in_flexmac(registers::Model model = registers::Model::mac140) {
    MotorBench b(model);
    b.send({0xFF});
    EXPECT_TRUE(b.motor.link().flexmac());
    return b;
}

/// What the motor sends up to the next status byte that is not part of a reply.
std::vector<std::uint8_t> reply_to(MotorBench& b, std::initializer_list<int> request) {
    b.send(request);
    b.sent.clear();
    b.pause(20);
    std::size_t size = b.sent.size();
    while (size > 0 && b.sent[size - 1] == b.sent.back()) --size;
    return {b.sent.begin(), b.sent.begin() + static_cast<std::ptrdiff_t>(size)};
}

// 001 §5.2.2: V_SOLL = 0547h in three ways; register numbers as in §3.2 (V_SOLL is 5).
TEST(FlexMacLink, ManualsWrites) {
    MotorBench b = in_flexmac();
    b.send({0x63, 0x63, 0x63, 0x47, 0xB8, 0x05, 0xFA});
    EXPECT_EQ(b.reg(V_SOLL), 0x0547);
    EXPECT_FALSE(b.motor.link().toggle()) << "one toggle for each message";
    b.set(V_SOLL, 0);
    b.send({0x60, 0x60, 0x60, 0x05, 0xFA, 0x47, 0xB8, 0x05, 0xFA});
    EXPECT_EQ(b.reg(V_SOLL), 0x0547);
    EXPECT_TRUE(b.motor.link().toggle());
    b.set(V_SOLL, 0);
    b.send({0x60, 0x60, 0x60, 0x00, 0xFF, 0x12, 0xED, 0x04, 0xFB, 0x47, 0xB8, 0x05, 0xFA});
    EXPECT_EQ(b.reg(V_SOLL), 0x0547);
    EXPECT_FALSE(b.motor.link().toggle());
    ASSERT_EQ(b.motor.orders().size(), 4U);  // with 1Fh
    for (std::size_t i = 1; i < 4; ++i) {
        EXPECT_TRUE(b.motor.orders()[i].flexmac);
        EXPECT_EQ(b.motor.orders()[i].reg, 5);
        EXPECT_EQ(b.motor.orders()[i].message.value, 0x0547U);
    }
}

// P_IST = 0003BD08h: 08 BD 03 00 with inverses F7 42 FC FF.
TEST(FlexMacLink, ManualsReads) {
    MotorBench b = in_flexmac();
    b.set(P_IST, 0x0003BD08);
    const std::vector<std::uint8_t> data{0x08, 0xF7, 0xBD, 0x42, 0x03, 0xFC, 0x00, 0xFF};
    const auto with_data = [&](std::vector<std::uint8_t> head) {
        head.insert(head.end(), data.begin(), data.end());
        return head;
    };
    EXPECT_EQ(reply_to(b, {0xF3, 0xF3, 0xF3}), with_data({0xF3, 0xF3, 0xF3}));
    EXPECT_EQ(b.status(), 0x08);
    EXPECT_EQ(reply_to(b, {0xF0, 0xF0, 0xF0, 0x0A, 0xF5}), with_data({0xF0, 0xF0, 0xF0, 0x0A, 0xF5}));
    EXPECT_EQ(b.status(), 0x88);
    EXPECT_EQ(reply_to(b, {0xF0, 0xF0, 0xF0, 0x00, 0xFF, 0x1C, 0xE3, 0x04, 0xFB}),
              with_data({0xF0, 0xF0, 0xF0, 0x00, 0xFF, 0x1C, 0xE3, 0x04, 0xFB}));
}

TEST(FlexMacLink, WriteIndices) {
    const int registers[] = {36, 3, 5, 6, 7, 13, 33, 49, 51, 65, 66, 73, 74, 81, 82};
    for (int index = 1; index <= 15; ++index) {
        MotorBench b = in_flexmac();
        const int header = 0x60 | index;
        b.send({header, header, header, 0x23, 0xDC, 0x01, 0xFE});
        EXPECT_EQ(b.reg(registers[index - 1]), 0x0123) << index;
    }
}

TEST(FlexMacLink, ReadIndices) {
    const int registers[] = {36, 8, 10, 12, 120, 122, 131, 121, 16, 18, 20, 24, 35};
    for (int index = 1; index <= 13; ++index) {
        MotorBench b = in_flexmac();
        b.set(registers[index - 1], 0x0200 + index);
        const auto header = static_cast<std::uint8_t>(0x70 | index);
        for (int i = 0; i < 3; ++i) b.motor.receive(header, false, b.at());  // before the next sample
        std::vector<std::uint8_t> bytes;
        for (int i = 0; i < 7; ++i) bytes.push_back(*b.motor.transmit(b.at()));
        const auto low = static_cast<std::uint8_t>(index);
        EXPECT_EQ(bytes, (std::vector<std::uint8_t>{header, header, header, low,
                                                    static_cast<std::uint8_t>(~low), 0x02, 0xFD}))
            << index;
    }
}

TEST(FlexMacLink, ReadIndicesOfMac800) {
    const std::pair<int, int> registers[] = {{3, 10}, {5, 163}, {6, 170}, {7, 178}, {8, 169}, {13, 35}};
    for (const auto& [index, reg] : registers) {
        MotorBench b = in_flexmac(registers::Model::mac800);
        b.set(reg, 0x11223344);
        const auto header = static_cast<std::uint8_t>(0xF0 | index);
        for (int i = 0; i < 3; ++i) b.motor.receive(header, false, b.at());  // before the next sample
        std::vector<std::uint8_t> bytes;
        for (int i = 0; i < 11; ++i) bytes.push_back(*b.motor.transmit(b.at()));
        EXPECT_EQ(bytes, (std::vector<std::uint8_t>{header, header, header, 0x44, 0xBB, 0x33, 0xCC, 0x22,
                                                    0xDD, 0x11, 0xEE}))
            << index;
    }
}

// R: the header decides the width.
TEST(FlexMacLink, WidthByHeader) {
    MotorBench b = in_flexmac();
    b.send({0xE3, 0xE3, 0xE3, 0x20, 0xDF, 0x03, 0xFC, 0x64, 0x9B, 0x00, 0xFF});
    EXPECT_EQ(b.reg(V_SOLL), 0x0320);
    EXPECT_EQ(b.reg(A_SOLL), 0x0064);
    b.set(P_SOLL, 0x00012345);
    b.send({0x62, 0x62, 0x62, 0xFF, 0x00, 0x00, 0xFF});
    EXPECT_EQ(b.reg(P_SOLL), 0x000100FF);
    b.send({0xE2, 0xE2, 0xE2, 0x70, 0x8F, 0x82, 0x7D, 0x03, 0xFC, 0x00, 0xFF});
    EXPECT_EQ(b.reg(P_SOLL), 230'000);
}

TEST(FlexMacLink, WritesActLikeRegisters) {
    MotorBench b = in_flexmac();
    b.set(P1, 4000);
    b.send({0x60, 0x60, 0x60, 0x2B, 0xD4, 0x01, 0xFE, 0x00, 0xFF});  // P_REG_P = 1
    b.send({0x60, 0x60, 0x60, 0x02, 0xFD, 0x02, 0xFD, 0x00, 0xFF});  // MODE_REG = 2
    b.until_in_position();
    b.settle();
    EXPECT_EQ(b.motor.p_ist(), 4000);
}

TEST(FlexMacLink, Mac800TakesLongwordsByNumberOnly) {
    MotorBench b = in_flexmac(registers::Model::mac800);
    b.send({0xE3, 0xE3, 0xE3, 0x47, 0xB8, 0x05, 0xFA, 0x00, 0xFF, 0x00, 0xFF});
    EXPECT_EQ(b.reg(V_SOLL), 0x0547);
    EXPECT_FALSE(b.motor.link().toggle());
    b.send({0xE0, 0xE0, 0xE0, 0x00, 0xFF, 0x12, 0xED, 0x04, 0xFB, 0x01, 0xFE, 0x00, 0xFF, 0x00, 0xFF, 0x00,
            0xFF});
    EXPECT_EQ(b.reg(V_SOLL), 0x0547);
    EXPECT_FALSE(b.motor.link().toggle()) << "the address form is refused";
    b.send({0x63, 0x63, 0x63, 0x01, 0xFE, 0x00, 0xFF});
    EXPECT_EQ(b.reg(V_SOLL), 0x0547);
    EXPECT_FALSE(b.motor.link().toggle()) << "a word is refused";
}

// R: two characters of silence drop what has come of a message.
TEST(FlexMacLink, PauseDropsTheMessage) {
    MotorBench b = in_flexmac();
    b.send({0x63, 0x63, 0x63, 0x47, 0xB8});
    b.pause(2);
    b.send({0x05, 0xFA});
    EXPECT_EQ(b.reg(V_SOLL), 1600);
    EXPECT_TRUE(b.motor.link().toggle());
    b.send({0x63, 0x63, 0x63, 0x47, 0xB8});
    b.pause(1);
    b.send({0x05, 0xFA});
    EXPECT_EQ(b.reg(V_SOLL), 0x0547);
}

// R: 63 63 63 63 9C 63 9C with one header byte lost is not a value; after a pause the line is in step again.
TEST(FlexMacLink, LostHeaderByteIsNotAValue) {
    MotorBench b = in_flexmac();
    b.send({0x63, 0x63, 0x63, 0x9C, 0x63, 0x9C});
    EXPECT_EQ(b.reg(V_SOLL), 1600);
    b.pause(2);
    b.send({0x63, 0x63, 0x63, 0x63, 0x9C, 0x63, 0x9C});
    EXPECT_EQ(b.reg(V_SOLL), 0x6363);
}

TEST(FlexMacLink, FramingErrorDropsTheMessage) {
    MotorBench b = in_flexmac();
    b.send({0x63, 0x63, 0x63, 0x47});
    b.send_one(0xB8, true);
    EXPECT_EQ(b.status() & 0x04, 0x04);
    b.send({0xB8, 0x05, 0xFA});
    EXPECT_EQ(b.reg(V_SOLL), 1600);
    b.send({0x63, 0x63, 0x63, 0x47, 0xB8, 0x05, 0xFA});
    EXPECT_EQ(b.reg(V_SOLL), 0x0547);
}

// 001 §5.2.1.7: a message that comes whole shows that the link is in step, without any pause.
TEST(FlexMacLink, AMessageEndsTheFramingError) {
    MotorBench b = in_flexmac();
    b.send_one(0x63, true);
    b.send({0x63, 0x63, 0x63, 0x47, 0xB8, 0x05});
    EXPECT_EQ(b.reg(ERR_STAT) & 1 << 8, 1 << 8);
    b.send({0xFA});
    EXPECT_EQ(b.status() & 0x04, 0);
    EXPECT_EQ(b.reg(ERR_STAT) & 1 << 8, 0);
}

TEST(FlexMacLink, NopAndBack) {
    MotorBench b = in_flexmac();
    EXPECT_EQ(b.status(), 0x88);
    b.send({0x7F, 0x7F, 0x7F});
    EXPECT_EQ(b.status(), 0x08);
    b.send({0x7E, 0x7E, 0x7E});
    EXPECT_EQ(b.status(), 0x80);
    b.send({0x00});
    EXPECT_EQ(b.status(), 0x00);
}

// Other RAM of the motor is not simulated: it reads 0 and keeps nothing.
TEST(FlexMacLink, AddressesOutsideTheRegisters) {
    MotorBench b = in_flexmac();
    EXPECT_EQ(reply_to(b, {0x70, 0x70, 0x70, 0x00, 0xFF, 0x00, 0xFF, 0x10, 0xEF}),
              (std::vector<std::uint8_t>{0x70, 0x70, 0x70, 0x00, 0xFF, 0x00, 0xFF, 0x10, 0xEF, 0x00, 0xFF,
                                         0x00, 0xFF}));
    b.send({0x60, 0x60, 0x60, 0x00, 0xFF, 0x13, 0xEC, 0x04, 0xFB, 0x47, 0xB8, 0x05, 0xFA});
    EXPECT_EQ(b.reg(V_SOLL), 1600);
    EXPECT_FALSE(b.motor.orders().back().effective);
    EXPECT_TRUE(b.motor.link().toggle());
}

TEST(FlexMacLink, RepliesSlowlyToo) {
    MotorBench b;
    b.command(protocol::fastmac::Number::transmit_slowly);
    b.command(protocol::fastmac::Number::use_flexmac);
    b.send({0x74, 0x74, 0x74});
    b.pause(2);
    b.sent.clear();
    b.pause(40);
    EXPECT_EQ(b.sent.size(), 20U);
}

TEST(FlexMacLink, ManyReadsAreRefusedNotPiledUp) {
    MotorBench b = in_flexmac();
    for (int n = 0; n < 50; ++n) {
        for (int i = 0; i < 3; ++i) b.motor.receive(0xF3, false, b.at());
    }
    std::size_t reply = 0;
    while ((*b.motor.transmit(b.at()) & 0xFF) != (b.motor.link().toggle() ? 0x88 : 0x08)) ++reply;
    EXPECT_LE(reply, 64U);
}

}  // namespace
}  // namespace nplc::sim
