// Orders, keys, pieces, topics and reports: RFC 8032's vectors, and what is not to be taken for one of them.
#include "orders/order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "orders/keys.h"
#include "orders/pieces.h"
#include "orders/report.h"
#include "orders/topics.h"

namespace nplc::orders {
namespace {

/// RFC 8032 §7.1, tests 1 to 3.
struct Vector {
    std::string_view seed;
    std::string_view key;
    std::string message;
    std::string_view signature;
};
const std::vector<Vector> kVectors{
    {"9d61b19deffd5a60ba844af492ec2cc44449c5697b326919703bac031cae7f60",
     "d75a980182b10ab7d54bfed3c964073a0ee172f3daa62325af021a68f707511a", "",
     "e5564300c360ac729086e2cc806e828a84877f1eb8e5d974d873e065224901555fb8821590a33bacc61e39701cf9b46bd25bf5f"
     "0"
     "595bbe24655141438e7a100b"},
    {"4ccd089b28ff96da9db6c346ec114e0f5b8a319f35aba624da8cf6ed4fb8a6fb",
     "3d4017c3e843895a92b70aa74d1b7ebc9c982ccf2ec4968cc0cd55f12af4660c", "\x72",
     "92a009a9f0d4cab8720e820b5f642540a2b27b5416503f8fb3762223ebdb69da085ac1e43e15996e458f3613d0f11d8c387b2ea"
     "e"
     "b4302aeeb00d291612bb0c00"},
    {"c5aa8df43f9f837bedb7442f31dcb7b166d38535076f094b85ce3a2e0b4458f7",
     "fc51cd8e6218a1a38da47ed00230f0580816ed13ba3303ac5deb911548908025", "\xaf\x82",
     "6291d657deec24024827e69c3abe01a30ce548a284743a445e3680d7db5ac3ac18ff9b538d16f290ae67f760984dc6594a7c15e"
     "9"
     "716ed28dc027beceea1ec40a"},
};

template <class Array>
Array bytes_of(std::string_view text) {
    Array bytes{};
    EXPECT_TRUE(read_hex(text, bytes)) << text;
    return bytes;
}

const Seed kSeed = bytes_of<Seed>(kVectors[0].seed);

Order order() {
    return {.target = "hall 2/cell4/x",
            .counter = 17,
            .name = "pick and place",
            .sha256 = sha256("a table"),
            .bytes = 7,
            .key = public_key_of(kSeed)};
}

bool is_right(std::string_view text) {
    const OrderReading read = read_order(text);
    return read.order && is_signed(read.order->message, read.order->signature, public_key_of(kSeed));
}

TEST(Crypto, SignsAndChecksAsTheRfcSays) {
    ASSERT_TRUE(has_crypto());
    for (const Vector& vector : kVectors) {
        const auto seed = bytes_of<Seed>(vector.seed);
        const auto key = bytes_of<PublicKey>(vector.key);
        const auto signature = bytes_of<Signature>(vector.signature);
        EXPECT_EQ(public_key_of(seed), key);
        EXPECT_EQ(sign(vector.message, seed), signature);
        EXPECT_TRUE(is_signed(vector.message, signature, key));
        EXPECT_FALSE(is_signed(vector.message + "x", signature, key));
        for (std::size_t bit = 0; bit < 8 * signature.size(); ++bit) {
            Signature wrong = signature;
            wrong[bit / 8] = static_cast<std::uint8_t>(wrong[bit / 8] ^ 1U << bit % 8);
            EXPECT_FALSE(is_signed(vector.message, wrong, key)) << bit;
        }
    }
}

/// FIPS 180-4's example, and nothing.
TEST(Crypto, HashesAsFipsSays) {
    EXPECT_EQ(hex(sha256("abc")), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(hex(sha256("")), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Crypto, EachSeedIsAnother) {
    EXPECT_NE(new_seed(), new_seed());
}

TEST(OrderText, ComesBackAsItWasWritten) {
    const std::string text = write_order(order(), kSeed);
    EXPECT_TRUE(text.starts_with(
        "nanoplc-order 1\nkind table\ntarget hall 2/cell4/x\ncounter 17\nname pick and place\n"));
    const OrderReading read = read_order(text);
    ASSERT_TRUE(read.order) << read.error;
    EXPECT_EQ(read.order->order, order());
    EXPECT_EQ(read.order->message, message_of(order()));
    EXPECT_TRUE(is_right(text));
}

TEST(OrderText, NoBitOfItMayBeAnother) {
    const std::string text = write_order(order(), kSeed);
    for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
        std::string wrong = text;
        wrong[bit / 8] = static_cast<char>(static_cast<unsigned char>(wrong[bit / 8]) ^ 1U << bit % 8);
        EXPECT_FALSE(is_right(wrong)) << bit;
    }
    for (std::size_t length = 0; length < text.size(); ++length)
        EXPECT_FALSE(read_order(std::string_view(text).substr(0, length)).order) << length;
    EXPECT_FALSE(is_right(text + "\n"));
    EXPECT_FALSE(is_right(text + text));
}

TEST(OrderText, SaysWhatIsWrong) {
    const std::string text = write_order(order(), kSeed);
    const auto error_of = [&text](std::string_view from, const std::string& to) {
        std::string wrong = text;
        wrong.replace(wrong.find(from), from.size(), to);
        return read_order(wrong).error;
    };
    EXPECT_EQ(error_of("counter 17", "counter 017"), "has a line `counter` that cannot be read");
    EXPECT_EQ(error_of("counter 17", "counter 0"), "has a line `counter` that cannot be read");
    EXPECT_EQ(error_of("counter 17", "counter 9223372036854775808"),
              "has a line `counter` that cannot be read");
    EXPECT_EQ(error_of("counter 17", "counter +1"), "has a line `counter` that cannot be read");
    EXPECT_EQ(error_of("counter 17", "count 17"), "has no line `counter` where it must be");
    EXPECT_EQ(error_of("bytes 7", "bytes 65537"), "has a line `bytes` that cannot be read");
    EXPECT_EQ(error_of("bytes 7", "bytes "), "has a line `bytes` that cannot be read");
    EXPECT_EQ(error_of("/x", "x"), "has a line `target` that cannot be read");
    EXPECT_EQ(error_of("/x", "/+"), "has a line `target` that cannot be read");
    EXPECT_EQ(error_of("/x", "//x"), "has a line `target` that cannot be read");
    EXPECT_EQ(error_of("pick", "\x1bpick"), "has a line `name` that cannot be read");
    EXPECT_EQ(error_of("kind table", "kind set_points"), "is no order for a table that this program knows");
    EXPECT_EQ(read_order(std::string(kLongestOrder + 1, 'x')).error, "is longer than 1024 bytes");
}

class KeyFolder : public ::testing::Test {
  protected:
    KeyFolder() : folder_(std::filesystem::temp_directory_path() / ("nplc_keys_" + hex(new_seed()))) {
        std::filesystem::create_directory(folder_);
    }
    ~KeyFolder() override { std::filesystem::remove_all(folder_); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }
    TrustedKeys read() const { return read_trusted(folder_.string()); }

    std::filesystem::path folder_;
};

TEST_F(KeyFolder, AllPublicKeysAreTrustedAndNothingElse) {
    const TrustedKey key{.name = "plant-1", .key = public_key_of(kSeed)};
    write("plant-1.pub", write_public(key));
    write("plant-1.key", write_secret("plant-1", kSeed));
    write("README", "keys");
    const TrustedKeys trusted = read();
    EXPECT_EQ(trusted.error, "");
    ASSERT_EQ(trusted.keys.size(), 1U);
    EXPECT_EQ(trusted.find(key.key)->name, "plant-1");
    EXPECT_EQ(trusted.find(PublicKey{}), nullptr);
    const auto secret = read_secret(write_secret("plant-1", kSeed));
    ASSERT_TRUE(secret);
    EXPECT_EQ(secret->seed, kSeed);
}

TEST_F(KeyFolder, OneThatIsNoKeyIsAnErrorOfAll) {
    const std::string good = write_public({.name = "a", .key = public_key_of(kSeed)});
    write("a.pub", good);
    for (const std::string& bad :
         {std::string(), good + good, good.substr(1), good.substr(0, good.size() - 1),
          "nanoplc-public-key  " + good.substr(21), write_secret("a", kSeed)}) {
        write("b.pub", bad);
        EXPECT_TRUE(read().keys.empty() || !read().error.empty()) << bad;
        EXPECT_NE(read().error, "") << bad;
    }
    std::filesystem::remove_all(folder_);
    EXPECT_NE(read().error, "");
}

TEST(Pieces, InAnyOrderSeveralTimesAndWrong) {
    std::vector<std::uint8_t> whole(2 * kPieceBytes + 5);
    for (std::size_t i = 0; i < whole.size(); ++i) whole[i] = static_cast<std::uint8_t>(i * 7 + i / 256);
    using Verdict = Pieces::Verdict;
    Pieces pieces(sha256(whole), whole.size());
    EXPECT_EQ(pieces.missing(), 3U);
    EXPECT_EQ(pieces.take(2, piece_of(whole, 2)), Verdict::taken);
    EXPECT_EQ(pieces.take(2, piece_of(whole, 2)), Verdict::taken);
    EXPECT_EQ(pieces.take(1, piece_of(whole, 2)), Verdict::not_one);
    EXPECT_EQ(pieces.take(2, piece_of(whole, 1)), Verdict::not_one);
    EXPECT_EQ(pieces.take(3, {}), Verdict::not_one);
    EXPECT_EQ(pieces.take(SIZE_MAX, {}), Verdict::not_one);
    EXPECT_EQ(pieces.take(1, piece_of(whole, 0)), Verdict::taken) << "of the right length";
    EXPECT_EQ(pieces.take(0, piece_of(whole, 0)), Verdict::wrong_whole);
    EXPECT_EQ(pieces.missing(), 3U);
    EXPECT_EQ(pieces.take(1, piece_of(whole, 1)), Verdict::taken);
    EXPECT_EQ(pieces.take(0, piece_of(whole, 0)), Verdict::taken);
    EXPECT_TRUE(pieces.artifact().empty());
    EXPECT_EQ(pieces.take(2, piece_of(whole, 2)), Verdict::whole);
    EXPECT_EQ(pieces.artifact(), whole);
}

TEST(Topics, AreReadAsTheyAreWritten) {
    const Hash hash = sha256("abc");
    const auto piece = read_piece_topic(piece_topic(hash, 12));
    ASSERT_TRUE(piece);
    EXPECT_EQ(piece->hash, hash);
    EXPECT_EQ(piece->number, 12U);
    for (const std::string& topic :
         {pieces_topic(hash), piece_topic(hash, 1) + "x", std::string("nanoplc/v1/artifact/"),
          "nanoplc/v1/artifact/" + hex(hash), order_topic("a/b/c")})
        EXPECT_FALSE(read_piece_topic(topic)) << topic;
    EXPECT_EQ(target_of(order_topic("a/b/c"), "order"), "a/b/c");
    EXPECT_EQ(target_of(order_topic("a/b/c"), "report"), std::nullopt);
    EXPECT_EQ(target_of("nanoplc/v1/order", "order"), std::nullopt);
    EXPECT_EQ(target_of("nanoplc/v1/a/b/order", "order"), std::nullopt);
}

TEST(ReportText, ComesBackAsItWasWritten) {
    Report report{.target = "a/b/c", .time = 1, .firmware = "0.1.0", .run_state = "running"};
    EXPECT_EQ(read_report(write_report(report)), report);
    report.table_sha256 = hex(sha256("abc"));
    report.table_crc = 0xFFFFFFFF;
    report.table_bytes = 24;
    report.table_name = "two";
    report.running = 1'764'000'000'000;
    report.recipe = 3;
    report.state = State::rolled_back;
    report.counter = INT64_MAX;
    report.text = "ERROR in step 3 on trial";
    report.refusals = 2;
    report.refusal = "an order is refused: it is for \"a\"";
    EXPECT_EQ(read_report(write_report(report)), report);
    for (const std::string text : {"", "[]", "{}", R"({"format":"nanoplc-report-2"})",
                                   R"({"format":"nanoplc-report-1","order":{"state":"gone"}})"})
        EXPECT_FALSE(read_report(text)) << text;
    std::string whole = write_report(report);
    whole.insert(whole.find('{') + 1, "\"x\":" + std::string(7'000, '[') + std::string(7'000, ']') + ",");
    EXPECT_FALSE(read_report(whole)) << "too deep";
}

}  // namespace
}  // namespace nplc::orders
