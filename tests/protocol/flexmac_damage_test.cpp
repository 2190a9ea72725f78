#include "flexmac_bytes.h"

#include <gtest/gtest.h>

#include <random>

namespace nplc::protocol::flexmac {
namespace {

ByteList without(const ByteList& bytes, std::size_t place) {
    ByteList rest = bytes;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(place));
    return rest;
}

/// 001 §5.2.2 has one hole, the same for every decoder: address xx00h with its register byte 00h lost. What
/// is left, FF 00, reads as register 255, and the message is that much shorter.
bool is_the_known_hole(const Message& message, std::size_t lost) {
    if (message.level != Level::address || lost != 3 || message.target % 256 != 0) return false;
    if (message.read) return true;
    // The data block shifts by one byte too: FF 00 pairs go on as far as the address and the data are 00.
    const std::uint32_t in_the_way = message.longword ? 0x00FFFFFF : 0x000000FF;
    return message.target == 0 && (message.value & in_the_way) == 0;
}

TEST(FlexMacDamage, EverySingleDamagedByteIsRefused) {
    for (const Message& message : telling_messages()) {
        const ByteList whole = list(encode(message));
        ASSERT_EQ(messages_in(whole).size(), 1u) << hex(whole);
        for (std::size_t place = 0; place < whole.size(); ++place) {
            for (int change = 1; change < 256; ++change) {
                ByteList bytes = whole;
                bytes[place] = static_cast<std::uint8_t>(bytes[place] ^ change);
                ASSERT_TRUE(messages_in(bytes).empty()) << hex(whole) << " as " << hex(bytes);
            }
        }
    }
}

TEST(FlexMacDamage, GoodMessageAfterTheDamagedOneAndAPauseIsTaken) {
    const ByteList good{0x63, 0x63, 0x63, 0x47, 0xB8, 0x05, 0xFA};
    for (const Message& message : telling_messages()) {
        const ByteList whole = list(encode(message));
        for (std::size_t place = 0; place < whole.size(); ++place) {
            ByteList bytes = whole;
            bytes[place] = static_cast<std::uint8_t>(bytes[place] ^ 0x10);
            RequestDecoder decoder;
            feed(decoder, bytes);
            decoder.abandon();
            const auto messages = feed(decoder, good);
            ASSERT_EQ(messages.size(), 1u) << hex(bytes);
            ASSERT_TRUE((messages[0] == Message{.target = 3, .value = 0x0547}));
        }
    }
}

TEST(FlexMacDamage, LosingOneByteBeforeAPauseGivesNothing) {
    int holes = 0;
    for (const Message& message : telling_messages()) {
        const ByteList whole = list(encode(message));
        for (std::size_t place = 0; place < whole.size(); ++place) {
            const auto messages = messages_in(without(whole, place));
            if (is_the_known_hole(message, place)) {
                ASSERT_EQ(messages.size(), 1u) << hex(whole) << " without byte " << place;
                ASSERT_EQ(messages[0].level, Level::reg);
                ASSERT_EQ(messages[0].target, 255);
                ++holes;
            } else {
                ASSERT_TRUE(messages.empty()) << hex(whole) << " without byte " << place;
            }
        }
    }
    EXPECT_GT(holes, 0);
}

// The register form has no such hole.
TEST(FlexMacDamage, RegisterFormHasNoHole) {
    std::mt19937 random(7);
    for (int i = 0; i < 20'000; ++i) {
        const Message message{
            .longword = random() % 2 == 0,
            .level = Level::reg,
            .target = static_cast<std::uint16_t>(1 + random() % 255),
            .value = static_cast<std::uint32_t>(random() % 4 == 0 ? random() : random() % 256)};
        const ByteList whole = list(encode(message));
        for (std::size_t place = 0; place < whole.size(); ++place) {
            ASSERT_TRUE(messages_in(without(whole, place)).empty()) << "seed 7: " << hex(whole) << place;
        }
    }
}

struct WriteResult {
    int second = 0;   // the second message arrives as it was sent
    int first = 0;    // so does the first, for all its lost byte
    int nothing = 0;  // nothing arrives
    int wrong = 0;    // a message arrives that was not sent
};

enum class Fault { lost, damaged };

/// Two word writes in index form with no pause between them, one byte of the first lost or damaged.
WriteResult two_writes_without_pause(Fault fault, std::uint32_t values) {
    std::mt19937 random(11);
    const auto write = [&] {
        const auto index = static_cast<std::uint16_t>(1 + random() % 15);
        return Message{.target = index, .value = static_cast<std::uint32_t>(random() % values)};
    };
    WriteResult outcome;
    for (int i = 0; i < 40'000; ++i) {
        const Message first = write();
        const Message second = write();
        ByteList bytes = list(encode(first));
        const std::size_t place = random() % bytes.size();
        if (fault == Fault::lost) bytes = without(bytes, place);
        if (fault == Fault::damaged)
            bytes[place] = static_cast<std::uint8_t>(bytes[place] ^ (1 + random() % 255));
        const ByteList next = list(encode(second));
        bytes.insert(bytes.end(), next.begin(), next.end());
        const auto messages = messages_in(bytes);
        if (messages.empty()) ++outcome.nothing;
        for (const Message& message : messages) {
            ++(message == second ? outcome.second : message == first ? outcome.first : outcome.wrong);
        }
    }
    return outcome;
}

// What the pause is for. One loss in 7 x 256 is that of the last inverse with the next header byte equal to
// it, one more that of the byte before, which makes the value wrong: 40000 / 7 / 256 = 22 each. Either
// swallows a header byte, so the second message goes too.
TEST(FlexMacDamage, LostByteWithoutPause) {
    const WriteResult outcome = two_writes_without_pause(Fault::lost, 0x10000);
    EXPECT_GT(outcome.wrong, 22 / 2);
    EXPECT_LT(outcome.wrong, 22 * 2);
    EXPECT_GT(outcome.first, 22 / 2);
    EXPECT_LT(outcome.first, 22 * 2);
    EXPECT_GT(outcome.second, 40'000 - 400);
}

// Values below 256 end in 00 FF, which no header byte completes.
TEST(FlexMacDamage, LostByteWithoutPauseIsHarmlessForSmallValues) {
    const WriteResult outcome = two_writes_without_pause(Fault::lost, 0x100);
    EXPECT_EQ(outcome.wrong, 0);
    EXPECT_EQ(outcome.first, 0);
    EXPECT_EQ(outcome.second, 40'000);
}

// A damaged byte keeps the count, so nothing of the first message is ever taken; the second is lost where the
// first ends in a byte equal to its header.
TEST(FlexMacDamage, DamagedByteWithoutPause) {
    const WriteResult outcome = two_writes_without_pause(Fault::damaged, 0x10000);
    EXPECT_EQ(outcome.wrong, 0);
    EXPECT_EQ(outcome.first, 0);
    EXPECT_GT(outcome.second, 40'000 - 400);
}

}  // namespace
}  // namespace nplc::protocol::flexmac
