// Long writes, which only the gateway takes, at its own address: the frame of 001 §5.1 with more data.
#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "protocol/mactalk.h"

namespace nplc::protocol::mactalk {
namespace {

constexpr std::uint8_t kGateway = 128;
constexpr std::uint8_t kWindow = 61;

std::vector<std::uint8_t> counting(std::size_t size) {
    std::vector<std::uint8_t> data(size);
    std::iota(data.begin(), data.end(), std::uint8_t{1});
    return data;
}

std::optional<Request> fed(RequestDecoder& decoder, std::span<const std::uint8_t> bytes) {
    std::optional<Request> last;
    for (const std::uint8_t byte : bytes) last = decoder.receive(byte);
    return last;
}

TEST(LongWrite, IsFramedAsAnyWrite) {
    // 52h x3, 80h, 3Dh, 08h, 01h..08h, each with its inverse, AAh x2.
    const std::vector<std::uint8_t> expected{0x52, 0x52, 0x52, 0x80, 0x7F, 0x3D, 0xC2, 0x08, 0xF7,
                                             0x01, 0xFE, 0x02, 0xFD, 0x03, 0xFC, 0x04, 0xFB, 0x05,
                                             0xFA, 0x06, 0xF9, 0x07, 0xF8, 0x08, 0xF7, 0xAA, 0xAA};
    const auto encoded = encode_long_write(kGateway, kWindow, counting(8));
    EXPECT_EQ(std::vector(encoded.view().begin(), encoded.view().end()), expected);
}

TEST(LongWrite, EveryLengthComesThroughAndTheDataWithIt) {
    RequestDecoder decoder;
    decoder.take_long_writes(kGateway);
    for (std::size_t size = 4; size <= kMaxLongWrite; size += 4) {
        const auto data = counting(size);
        const auto request = fed(decoder, encode_long_write(kGateway, kWindow, data).view());
        ASSERT_TRUE(request) << size;
        EXPECT_EQ(request->reg, kWindow);
        EXPECT_EQ(request->length, size);
        EXPECT_EQ(request->value, 0x0403'0201U);
        EXPECT_EQ(std::vector(decoder.data().begin(), decoder.data().end()), data);
    }
}

TEST(LongWrite, IsNoMessageForAnyOtherUnit) {
    const auto bytes = encode_long_write(kGateway, kWindow, counting(8));
    RequestDecoder motor;
    EXPECT_FALSE(fed(motor, bytes.view()));
    RequestDecoder other;
    other.take_long_writes(kGateway + 1);
    EXPECT_FALSE(fed(other, bytes.view()));
    RequestDecoder everyone;
    everyone.take_long_writes(kGateway);
    EXPECT_FALSE(fed(everyone, encode_long_write(kEveryone, kWindow, counting(8)).view()));
}

TEST(LongWrite, OtherLengthsCannotBeSaid) {
    for (const std::size_t size : {0U, 2U, 3U, 6U, 130U, 132U, 256U}) {
        EXPECT_TRUE(encode_long_write(kGateway, kWindow, std::vector<std::uint8_t>(size)).view().empty())
            << size;
    }
    EXPECT_TRUE(encode_long_write(kGateway, 0, counting(4)).view().empty());
}

TEST(LongWrite, EveryDamagedByteIsRefusedAndTheNextMessageUnderstood) {
    const auto good = encode_long_write(kGateway, kWindow, counting(kMaxLongWrite));
    for (std::size_t at = 0; at < good.size; ++at) {
        auto bad = good;
        bad.bytes[at] ^= 0x10;
        RequestDecoder decoder;
        decoder.take_long_writes(kGateway);
        EXPECT_FALSE(fed(decoder, bad.view())) << at;
        EXPECT_TRUE(fed(decoder, good.view())) << at;
    }
}

TEST(LongWrite, DataStayUntilTheNextByte) {
    RequestDecoder decoder;
    decoder.take_long_writes(kGateway);
    ASSERT_TRUE(fed(decoder,
                    encode({.kind = Kind::write, .address = 7, .reg = 5, .length = 2, .value = 600}).view()));
    EXPECT_EQ(std::vector(decoder.data().begin(), decoder.data().end()),
              (std::vector<std::uint8_t>{0x58, 0x02}));
    static_cast<void>(decoder.receive(0));
    EXPECT_TRUE(decoder.data().empty());
}

}  // namespace
}  // namespace nplc::protocol::mactalk
