// RFC 8032 §7.1, and what is not to be taken for a signature.

#include "signature/ed25519.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace nplc::signature {
namespace {

std::vector<std::uint8_t> bytes_of(std::string_view text) {
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i + 1 < text.size(); i += 2)
        bytes.push_back(static_cast<std::uint8_t>(std::stoul(std::string(text.substr(i, 2)), nullptr, 16)));
    return bytes;
}

template <class Array>
Array array_of(std::string_view text) {
    Array result{};
    const auto bytes = bytes_of(text);
    EXPECT_EQ(bytes.size(), result.size());
    std::copy_n(bytes.begin(), std::min(bytes.size(), result.size()), result.begin());
    return result;
}

struct Vector {
    const char* key;
    const char* message;
    const char* signature;
};

constexpr Vector kVectors[]{{"d75a980182b10ab7d54bfed3c964073a0ee172f3daa62325af021a68f707511a", "",
                             "e5564300c360ac729086e2cc806e828a84877f1eb8e5d974d873e065224901555fb8821590a33ba"
                             "cc61e39701cf9b46bd25bf5f05"
                             "95bbe24655141438e7a100b"},
                            {"3d4017c3e843895a92b70aa74d1b7ebc9c982ccf2ec4968cc0cd55f12af4660c", "72",
                             "92a009a9f0d4cab8720e820b5f642540a2b27b5416503f8fb3762223ebdb69da085ac1e43e15996"
                             "e458f3613d0f11d8c387b2eaeb"
                             "4302aeeb00d291612bb0c00"},
                            {"fc51cd8e6218a1a38da47ed00230f0580816ed13ba3303ac5deb911548908025", "af82",
                             "6291d657deec24024827e69c3abe01a30ce548a284743a445e3680d7db5ac3ac18ff9b538d16f29"
                             "0ae67f760984dc6594a7c15e97"
                             "16ed28dc027beceea1ec40a"},
                            {"ec172b93ad5e563bf4932c70e1245034c35467ef2efd4d64ebf819683467e2bf",
                             "ddaf35a193617abacc417349ae20413112e6fa4e89a97ea20a9eeee64b55d39a2192992a274fc1a"
                             "836ba3c23a3feebbd454d44236"
                             "43ce80e2a9ac94fa54ca49f",
                             "dc2a4459e7369633a52b1bf277839a00201009a3efbf3ecb69bea2186c26b58909351fc9ac90b3e"
                             "cfdfbc7c66431e0303dca179c1"
                             "38ac17ad9bef1177331a704"}};

unsigned called = 0;

bool judge(std::span<const std::uint8_t> message, const Signature& signature, const PublicKey& key) {
    return is_signed(message, signature, key, [] { ++called; });
}

TEST(Ed25519, TheRfcsVectorsAreSigned) {
    for (const Vector& vector : kVectors) {
        called = 0;
        EXPECT_TRUE(judge(bytes_of(vector.message), array_of<Signature>(vector.signature),
                          array_of<PublicKey>(vector.key)))
            << vector.signature;
        EXPECT_GT(called, 256U) << "a watchdog is to be fed meanwhile";
    }
}

TEST(Ed25519, AnotherMessageIsNot) {
    const Vector& vector = kVectors[2];
    const auto signature = array_of<Signature>(vector.signature);
    const auto key = array_of<PublicKey>(vector.key);
    EXPECT_FALSE(judge(bytes_of("af83"), signature, key));
    EXPECT_FALSE(judge(bytes_of("af"), signature, key));
    EXPECT_FALSE(judge(bytes_of("af8200"), signature, key));
}

TEST(Ed25519, NoBitOfASignatureOrOfAKeyMayBeAnother) {
    const Vector& vector = kVectors[1];
    const auto message = bytes_of(vector.message);
    const auto signature = array_of<Signature>(vector.signature);
    const auto key = array_of<PublicKey>(vector.key);
    for (std::size_t bit = 0; bit < 8 * signature.size(); ++bit) {
        Signature other = signature;
        other[bit / 8] = static_cast<std::uint8_t>(other[bit / 8] ^ (1U << (bit % 8)));
        EXPECT_FALSE(judge(message, other, key)) << "signature, bit " << bit;
    }
    for (std::size_t bit = 0; bit < 8 * key.size(); ++bit) {
        PublicKey other = key;
        other[bit / 8] = static_cast<std::uint8_t>(other[bit / 8] ^ (1U << (bit % 8)));
        EXPECT_FALSE(judge(message, signature, other)) << "key, bit " << bit;
    }
}

/// S + L signs the same by arithmetic; RFC 8032 §5.1.7 refuses it.
TEST(Ed25519, ANumberBeyondTheOrderIsRefused) {
    const Vector& vector = kVectors[0];
    auto signature = array_of<Signature>(vector.signature);
    const auto order = bytes_of("edd3f55c1a631258d69cf7a2def9de1400000000000000000000000000000010");
    unsigned carry = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        carry += unsigned{signature[32 + i]} + order[i];
        signature[32 + i] = static_cast<std::uint8_t>(carry);
        carry >>= 8;
    }
    EXPECT_FALSE(judge({}, signature, array_of<PublicKey>(vector.key)));
}

TEST(Ed25519, AKeyThatIsNoPointIsRefused) {
    PublicKey key{};
    key[0] = 2;  // y = 2 has no x
    EXPECT_FALSE(judge({}, array_of<Signature>(kVectors[0].signature), key));
    key = {1};  // y = 1 has x = 0, which has no odd form
    key[31] = 0x80;
    EXPECT_FALSE(judge({}, array_of<Signature>(kVectors[0].signature), key));
}

}  // namespace
}  // namespace nplc::signature
