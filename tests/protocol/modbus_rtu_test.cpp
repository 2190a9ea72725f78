#include "protocol/modbus_rtu.h"

#include <gtest/gtest.h>

#include <string_view>

namespace nplc::protocol::modbus {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Slave 17 reads 3 holding registers from 107 on, and its answer: the example of the Modbus reference.
const Bytes kRequest{0x11, 0x03, 0x00, 0x6B, 0x00, 0x03, 0x76, 0x87};
const Bytes kAnswer{0x11, 0x03, 0x06, 0xAE, 0x41, 0x56, 0x52, 0x43, 0x40, 0x49, 0xAD};

/// How many frames the bytes are.
unsigned feed(RtuReader& reader, const Bytes& bytes) {
    unsigned frames = 0;
    for (const std::uint8_t byte : bytes) frames += reader.take(byte) ? 1U : 0U;
    return frames;
}

Bytes frame(std::uint8_t unit, const Bytes& pdu) {
    const RtuFrame made(unit, pdu);
    return {made.bytes().begin(), made.bytes().end()};
}

TEST(ModbusRtu, CheckSum) {
    constexpr std::string_view kDigits = "123456789";
    const Bytes digits(kDigits.begin(), kDigits.end());
    EXPECT_EQ(crc16(digits), 0x4B37);  // as catalogues of check sums have it for CRC-16/MODBUS
    EXPECT_EQ(frame(0x11, {0x03, 0x00, 0x6B, 0x00, 0x03}), kRequest);
}

TEST(ModbusRtu, SilenceBetweenFrames) {
    // 3.5 characters of 11 bits: 38.5 bits at 9600 baud are 4010.4 us.
    EXPECT_EQ(silence_between_frames(9'600).count(), 4'011);
    EXPECT_EQ(silence_between_frames(19'200).count(), 2'006);
    EXPECT_EQ(silence_between_frames(38'400).count(), 1'750);
}

TEST(ModbusRtu, TakesARequest) {
    RtuReader reader;
    EXPECT_EQ(feed(reader, kRequest), 1U);
    EXPECT_EQ(reader.unit(), 0x11);
    EXPECT_EQ(Bytes(reader.pdu().begin(), reader.pdu().end()), (Bytes{0x03, 0x00, 0x6B, 0x00, 0x03}));
    EXPECT_FALSE(reader.is_under_way());
    EXPECT_FALSE(reader.silence());
}

TEST(ModbusRtu, PassesOverWhatNeighboursAnswer) {
    RtuReader reader;
    Bytes line = kRequest;
    line.insert(line.end(), kAnswer.begin(), kAnswer.end());
    const Bytes refusal = frame(0x12, {0x83, 0x02});
    line.insert(line.end(), refusal.begin(), refusal.end());
    const Bytes last = frame(0x01, {0x10, 0x00, 0x00, 0x00, 0x01, 0x02, 0x00, 0x02});
    line.insert(line.end(), last.begin(), last.end());
    EXPECT_EQ(feed(reader, line), 4U);  // without a silence between them
    EXPECT_EQ(reader.unit(), 0x01);
    EXPECT_EQ(reader.pdu().size(), 8U);
}

TEST(ModbusRtu, EndsAnAnswerByItsFunction) {
    for (unsigned number = 0; number < 0x80; ++number) {
        const auto function = static_cast<std::uint8_t>(number);
        const bool reads = number >= 1 && number <= 4;
        const bool writes = number == 5 || number == 6 || number == 15 || number == 16;
        RtuReader of_read;
        EXPECT_EQ(feed(of_read, frame(0x12, {function, 2, 0x12, 0x34})), reads ? 1U : 0U) << number;
        EXPECT_EQ(of_read.silence(), !reads) << number;
        RtuReader of_write;
        EXPECT_EQ(feed(of_write, frame(0x12, {function, 0x12, 0x34, 0x56, 0x78})),
                  reads || writes ? 1U : 0U)  // of a read, a request
            << number;
    }
}

TEST(ModbusRtu, AFunctionThatNobodyKnowsEndsAtASilence) {
    RtuReader reader;
    EXPECT_EQ(feed(reader, frame(0x01, {0x2B, 0x0E, 0x01, 0x00})), 0U);
    EXPECT_TRUE(reader.is_under_way());
    EXPECT_TRUE(reader.silence());
    EXPECT_EQ(reader.pdu()[0], 0x2B);
    EXPECT_EQ(feed(reader, kRequest), 1U);
}

TEST(ModbusRtu, WhatIsDamagedIsNoFrame) {
    for (std::size_t byte = 0; byte < kRequest.size(); ++byte) {
        for (unsigned bit = 0; bit < 8; ++bit) {
            Bytes wrong = kRequest;
            wrong[byte] = static_cast<std::uint8_t>(wrong[byte] ^ 1U << bit);
            RtuReader reader;
            EXPECT_EQ(feed(reader, wrong), 0U) << byte << "." << bit;
            EXPECT_FALSE(reader.silence());
            EXPECT_EQ(feed(reader, kRequest), 1U);
        }
    }
}

TEST(ModbusRtu, AfterAnErrorItWaitsForASilence) {
    RtuReader reader;
    reader.damaged();
    EXPECT_EQ(feed(reader, kRequest), 0U);
    EXPECT_TRUE(reader.is_under_way());
    EXPECT_FALSE(reader.silence());
    EXPECT_EQ(feed(reader, kRequest), 1U);
}

TEST(ModbusRtu, HalfAFrameAndTooMuch) {
    RtuReader reader;
    EXPECT_EQ(feed(reader, frame(0x11, {})), 0U);
    EXPECT_FALSE(reader.silence()) << "a right check sum and no function";
    EXPECT_EQ(feed(reader, {kRequest.begin(), kRequest.begin() + 5}), 0U);
    EXPECT_FALSE(reader.silence());
    EXPECT_EQ(feed(reader, Bytes(1000, 0x41)), 0U);
    EXPECT_FALSE(reader.silence());
    EXPECT_EQ(feed(reader, kRequest), 1U);
}

}  // namespace
}  // namespace nplc::protocol::modbus
