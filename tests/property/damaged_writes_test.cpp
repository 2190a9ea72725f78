// Ten million damaged writes: what a motor would take wrongly, and why no receiver could have seen it.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <optional>
#include <random>
#include <vector>

#include "protocol/mactalk.h"

namespace nplc::protocol::mactalk {
namespace {

constexpr int kFrames = NPLC_DAMAGED_FRAMES;

using Bytes = std::vector<std::uint8_t>;
using Random = std::mt19937_64;

Request any_write(Random& random) {
    const bool longword = random() % 2 == 0;
    return {.kind = Kind::write,
            .address = static_cast<std::uint8_t>(1 + random() % 254),
            .reg = static_cast<std::uint8_t>(1 + random() % 255),
            .length = static_cast<std::uint8_t>(longword ? 4 : 2),
            .value = static_cast<std::uint32_t>(random()) & (longword ? 0xFFFF'FFFF : 0xFFFF)};
}

/// One to six bytes flipped somewhere, lost, doubled or put in; more often bits than whole bytes.
void damage(Bytes& line, Random& random) {
    for (auto n = 1 + random() % 6; n > 0 && !line.empty(); --n) {
        const auto at = line.begin() + static_cast<std::ptrdiff_t>(random() % line.size());
        switch (random() % 8) {
            case 0:
                line.erase(at);
                break;
            case 1:
                line.insert(at, static_cast<std::uint8_t>(random()));
                break;
            case 2:
                *at = static_cast<std::uint8_t>(random());
                break;
            default:
                *at ^= static_cast<std::uint8_t>(1U << random() % 8);
        }
    }
}

/// The bytes that a byte and its inverse must have been damaged in alike for a wrong value to pass: counted
/// where sent and received messages have the same length.
int pairs_changed(const Bytes& sent, const Bytes& received) {
    int count = 0;
    for (std::size_t i = 3; i + 3 < sent.size(); i += 2) {
        if (sent[i] == received[i]) continue;
        ++count;
        EXPECT_NE(sent[i + 1], received[i + 1]);
        EXPECT_EQ(sent[i] ^ received[i], sent[i + 1] ^ received[i + 1]) << "the same bits of both";
    }
    return count;
}

Bytes list(const EncodedRequest& encoded) {
    return {encoded.view().begin(), encoded.view().end()};
}

TEST(DamagedWrites, AWrongOneNeedsAByteAndItsInverseDamagedAlike) {
    Random random(7);
    RequestDecoder decoder;
    int right = 0;
    int wrong = 0;
    for (int i = 0; i < kFrames; ++i) {
        const Request sent = any_write(random);
        const Bytes good = list(encode(sent));
        Bytes line = good;
        damage(line, random);
        std::optional<Request> got;
        decoder.abandon();
        for (const std::uint8_t byte : line) {
            if (const auto request = decoder.receive(byte)) got = request;
        }
        if (!got) continue;
        if (*got == sent) {
            ++right;
            continue;
        }
        ++wrong;
        const Bytes taken = list(encode(*got));
        ASSERT_EQ(taken.size(), good.size()) << "seed 7, frame " << i;
        ASSERT_GE(pairs_changed(good, taken) + (good[0] != taken[0] ? 1 : 0), 1) << "seed 7, frame " << i;
    }
    std::printf("seed 7: of %d damaged writes %d were taken as sent, %d as another well-formed message\n",
                kFrames, right, wrong);
    EXPECT_LT(wrong, kFrames / 1000);
}

}  // namespace
}  // namespace nplc::protocol::mactalk
