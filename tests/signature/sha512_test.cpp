// FIPS 180-4's examples, and lengths and pieces around a block.

#include "signature/sha512.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace nplc::signature {
namespace {

std::string hex_of(const Digest512& digest) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text;
    for (const std::uint8_t byte : digest) {
        text += kDigits[byte >> 4];
        text += kDigits[byte & 0xF];
    }
    return text;
}

std::vector<std::uint8_t> text_bytes(std::string_view text) {
    return {text.begin(), text.end()};
}

std::string hash_of(std::span<const std::uint8_t> bytes) {
    Sha512 hash;
    hash.add(bytes);
    return hex_of(hash.end());
}

TEST(Sha512, HashesTheStandardsExamples) {
    EXPECT_EQ(hash_of({}),
              "cf83e1357eefb8bdf1542850d66d8007d620e4050b5715dc83f4a921d36ce9ce"
              "47d0d13c5d85f2b0ff8318d2877eec2f63b931bd47417a81a538327af927da3e");
    EXPECT_EQ(hash_of(text_bytes("abc")),
              "ddaf35a193617abacc417349ae20413112e6fa4e89a97ea20a9eeee64b55d39a"
              "2192992a274fc1a836ba3c23a3feebbd454d4423643ce80e2a9ac94fa54ca49f");
    EXPECT_EQ(
        hash_of(text_bytes("abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmnhijklmnoijklmnopjklmn"
                           "opqklmnopqrlmnopqrsm"
                           "nopqrstnopqrstu")),
        "8e959b75dae313da8cf4f72814fc143f8f7779c6eb9f7fa17299aeadb6889018"
        "501d289e4900f7e4331b99dec4b5433ac7d329eeb6dd26545e96e55b874be909");
}

/// The hash of the hashes of messages of 0 to 300 bytes, as Python's hashlib has it.
TEST(Sha512, EveryLengthAroundABlockIsRight) {
    Sha512 all;
    for (unsigned length = 0; length <= 300; ++length) {
        std::vector<std::uint8_t> message(length);
        for (unsigned i = 0; i < length; ++i) message[i] = static_cast<std::uint8_t>(i * 7 + length);
        Sha512 one;
        one.add(message);
        all.add(one.end());
    }
    EXPECT_EQ(hex_of(all.end()),
              "e1f2f7d5d8fc48db06ec2a0eed639593f549caffa40245747258761214a3ec07"
              "134903fde52ace6cfae161a82097ba01f33a97d48dd6a80d4521d96d7401357e");
}

TEST(Sha512, PiecesAreAsGoodAsTheWhole) {
    std::vector<std::uint8_t> message(500);
    for (std::size_t i = 0; i < message.size(); ++i) message[i] = static_cast<std::uint8_t>(i * 31);
    const std::string whole = hash_of(message);
    for (std::size_t piece = 1; piece <= 200; ++piece) {
        Sha512 hash;
        for (std::size_t at = 0; at < message.size(); at += piece)
            hash.add(std::span(message).subspan(at, std::min(piece, message.size() - at)));
        EXPECT_EQ(hex_of(hash.end()), whole) << piece;
    }
}

}  // namespace
}  // namespace nplc::signature
