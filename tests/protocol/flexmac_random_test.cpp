#include "flexmac_bytes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace nplc::protocol::flexmac {
namespace {

/// Bytes that often are header bytes and often repeat, so that decoders get deep.
ByteList noise(std::mt19937& random, std::size_t size) {
    ByteList bytes;
    while (bytes.size() < size) {
        const auto any = static_cast<std::uint8_t>(random());
        const auto byte = random() % 2 == 0 ? any : static_cast<std::uint8_t>(any | 0x60);
        switch (random() % 4) {
            case 0:
                bytes.insert(bytes.end(), 3, byte);
                break;
            case 1:
                bytes.insert(bytes.end(), {byte, static_cast<std::uint8_t>(~byte)});
                break;
            case 2:
                bytes.push_back(byte);
                break;
            default:
                bytes.insert(bytes.end(), {0x00, 0xFF});
                break;
        }
    }
    return bytes;
}

Message any_message(std::mt19937& random) {
    Message message{.read = random() % 2 == 0, .longword = random() % 2 == 0};
    message.level = static_cast<Level>(random() % 3);
    const std::uint32_t target = random() & 0xFFFF;
    if (message.level == Level::index) message.target = static_cast<std::uint16_t>(1 + target % 13);
    if (message.level == Level::reg) message.target = static_cast<std::uint16_t>(1 + target % 255);
    if (message.level == Level::address) message.target = static_cast<std::uint16_t>(target);
    const auto value = static_cast<std::uint32_t>(random());
    if (!message.read) message.value = message.longword ? value : value & 0xFFFF;
    return message;
}

bool ends_with(const ByteList& bytes, std::size_t size, std::span<const std::uint8_t> tail) {
    return size >= tail.size() && std::equal(tail.begin(), tail.end(),
                                             bytes.begin() + static_cast<std::ptrdiff_t>(size - tail.size()));
}

TEST(FlexMacRandom, EveryMessageComesBack) {
    std::mt19937 random(1);
    RequestDecoder motor;
    ReplyDecoder master;
    for (int i = 0; i < 50'000; ++i) {
        const Message message = any_message(random);
        const auto got = feed(motor, list(encode(message)));
        ASSERT_EQ(got.size(), 1u) << "seed 1, round " << i;
        ASSERT_TRUE(got[0] == message) << "seed 1, round " << i;
        if (!message.read) continue;
        const auto value = static_cast<std::uint32_t>(random());
        const Heard heard = feed(master, list(encode_reply(message, value)));
        ASSERT_EQ(heard.replies.size(), 1u) << "seed 1, round " << i;
        ASSERT_EQ(heard.replies[0].value, message.longword ? value : value & 0xFFFF);
        ASSERT_EQ(heard.replies[0].target, message.target);
    }
}

TEST(FlexMacRandom, AMessageIsTheBytesThatCameLast) {
    std::mt19937 random(2);
    for (int round = 0; round < 300; ++round) {
        const ByteList bytes = noise(random, 1000);
        RequestDecoder decoder;
        for (std::size_t i = 0; i < bytes.size(); ++i) {
            const auto message = decoder.receive(bytes[i]);
            if (!message) continue;
            ASSERT_TRUE(ends_with(bytes, i + 1, encode(*message).view())) << "seed 2, round " << round;
        }
    }
}

TEST(FlexMacRandom, AReplyIsTheBytesThatCameLast) {
    std::mt19937 random(3);
    int replies = 0;
    for (int round = 0; round < 300; ++round) {
        const ByteList bytes = noise(random, 1000);
        ReplyDecoder decoder;
        for (std::size_t i = 0; i < bytes.size(); ++i) {
            const auto event = decoder.receive(bytes[i]);
            if (event.kind != ReplyDecoder::Event::Kind::reply) continue;
            ++replies;
            const Encoded encoded = encode_reply(event.reply, event.reply.value);
            ASSERT_TRUE(ends_with(bytes, i + 1, encoded.view())) << "seed 3, round " << round;
        }
    }
    EXPECT_GT(replies, 100);
}

TEST(FlexMacRandom, GoodMessageAfterNoiseAndAPauseIsTaken) {
    std::mt19937 random(4);
    RequestDecoder decoder;
    for (int round = 0; round < 20'000; ++round) {
        feed(decoder, noise(random, random() % 40));
        decoder.abandon();
        const Message message = any_message(random);
        const auto got = feed(decoder, list(encode(message)));
        ASSERT_EQ(got.size(), 1u) << "seed 4, round " << round;
        ASSERT_TRUE(got[0] == message) << "seed 4, round " << round;
    }
}

// Five equal status bytes are enough after anything: one may stand as data, one breaks the reply, three make
// it sure.
TEST(FlexMacRandom, StatusIsBackAfterNoise) {
    std::mt19937 random(5);
    ReplyDecoder decoder;
    for (int round = 0; round < 50'000; ++round) {
        feed(decoder, noise(random, random() % 40));
        const auto status = static_cast<std::uint8_t>(random() & 0x9F);
        const Heard heard = feed(decoder, ByteList(5, status));
        ASSERT_FALSE(heard.status.empty()) << "seed 5, round " << round;
        ASSERT_EQ(heard.status.back(), status) << "seed 5, round " << round;
        const Heard reply = feed(decoder, list(encode_reply({.read = true, .target = 4}, 0x1234)));
        ASSERT_EQ(reply.replies.size(), 1u) << "seed 5, round " << round;
    }
}

}  // namespace
}  // namespace nplc::protocol::flexmac
