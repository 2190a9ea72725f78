#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <random>

#include "mactalk_bytes.h"

namespace nplc::protocol::mactalk {
namespace {

using Random = std::mt19937;

Request any_request(Random& random) {
    Request request{.kind = static_cast<Kind>(0x50 + random() % 8),
                    .address = static_cast<std::uint8_t>(1 + random() % 255)};
    const bool has_register =
        request.kind == Kind::read || request.kind == Kind::read_block || request.kind == Kind::write;
    if (has_register) request.reg = static_cast<std::uint8_t>(1 + random() % 255);
    if (request.kind != Kind::write) return request;
    request.length = random() % 2 == 0 ? 2 : 4;
    request.value = static_cast<std::uint32_t>(random());
    if (request.length == 2) request.value &= 0xFFFF;
    return request;
}

TEST(MacTalkDamage, EveryRequestComesBack) {
    Random random(1);
    RequestDecoder decoder;
    for (int i = 0; i < 100'000; ++i) {
        const Request request = any_request(random);
        const auto got = feed(decoder, list(encode(request)));
        ASSERT_EQ(got.size(), 1u) << "seed 1, round " << i;
        ASSERT_TRUE(got[0] == request) << "seed 1, round " << i;
    }
}

TEST(MacTalkDamage, ASingleDamagedByteIsAlwaysSeen) {
    Random random(2);
    for (int i = 0; i < 20; ++i) {
        const ByteList good = list(encode(any_request(random)));
        for (std::size_t at = 0; at < good.size(); ++at) {
            for (unsigned value = 0; value < 256; ++value) {
                if (good[at] == value) continue;
                ByteList bad = good;
                bad[at] = static_cast<std::uint8_t>(value);
                ASSERT_TRUE(requests_in(bad).empty())
                    << "seed 2, round " << i << ", byte " << at << " := " << value;
            }
        }
    }
}

TEST(MacTalkDamage, ALostOrADoubledByteNeverMakesAnotherMessage) {
    Random random(3);
    for (int i = 0; i < 2'000; ++i) {
        const Request request = any_request(random);
        const ByteList good = list(encode(request));
        for (std::size_t at = 0; at < good.size(); ++at) {
            ByteList lost = good;
            lost.erase(lost.begin() + static_cast<std::ptrdiff_t>(at));
            ASSERT_TRUE(requests_in(lost).empty()) << "seed 3, round " << i << ", byte " << at;
            ByteList doubled = good;
            doubled.insert(doubled.begin() + static_cast<std::ptrdiff_t>(at), good[at]);
            for (const Request& got : requests_in(doubled))
                ASSERT_TRUE(got == request) << "seed 3, round " << i << ", byte " << at;
        }
    }
}

std::size_t damaged_bytes(const ByteList& sent, const ByteList& received) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < sent.size(); ++i) {
        if (sent[i] != received[i]) ++count;
    }
    return count;
}

// What doubled bytes cannot see: a byte and its inverse damaged in the same bits, or all three first bytes
// alike. That is the whole list: whatever is reported is, byte for byte, a well-formed message.
TEST(MacTalkDamage, NothingIsReportedThatIsNotOnTheLineByteForByte) {
    Random random(4);
    int reported = 0;
    for (int i = 0; i < 1'000'000; ++i) {
        const Request sent = any_request(random);
        const ByteList good = list(encode(sent));
        ByteList line = good;
        for (int n = 1 + static_cast<int>(random() % 4); n > 0; --n)
            line[random() % line.size()] ^= static_cast<std::uint8_t>(1U << random() % 8);
        for (const Request& got : requests_in(line)) {
            ++reported;
            ASSERT_EQ(list(encode(got)), line) << "seed 4, round " << i;
            const bool is_sent = got == sent;
            ASSERT_TRUE(is_sent || damaged_bytes(good, line) >= 2) << "seed 4, round " << i;
        }
    }
    std::printf("seed 4: %d of 1000000 damaged messages were whole messages\n", reported);
    EXPECT_GT(reported, 0);
    EXPECT_LT(reported, 100'000);
}

TEST(MacTalkDamage, AReplyIsTheBytesThatCameLast) {
    Random random(5);
    for (int i = 0; i < 20'000; ++i) {
        const std::uint8_t reg = static_cast<std::uint8_t>(1 + random() % 255);
        std::array<std::uint8_t, 4> data{};
        for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>(random());
        const ByteList good = list(encode_registers(reg, data));
        ByteList noise;
        for (std::size_t n = random() % 8; n > 0; --n)
            noise.push_back(random() % 2 == 0 ? 0x52 : static_cast<std::uint8_t>(random()));
        const auto got = replies_in(noise + good, Answer::registers, kReadBytes);
        ASSERT_EQ(got.size(), 1u) << "seed 5, round " << i;
        ASSERT_EQ(got[0].reg, reg);
        ASSERT_TRUE(std::equal(data.begin(), data.end(), got[0].data.begin())) << "seed 5, round " << i;
    }
}

}  // namespace
}  // namespace nplc::protocol::mactalk
