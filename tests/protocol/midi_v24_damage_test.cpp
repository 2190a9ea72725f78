#include <gtest/gtest.h>

#include <random>

#include "midi_v24_text.h"

namespace nplc::protocol::midi_v24 {
namespace {

using EventKind = RequestDecoder::Event::Kind;

const Request kGo{.address = 0x01, .index = 0x13, .data = 0x0012'D687};

/// Places of the frame, 0 is Stx.
constexpr std::size_t kFirstField = 4;
constexpr std::size_t kEnd = 20;

// Every other byte at every place. 000 §II: Nack if the sum is wrong.
TEST(MidiV24Damage, NoDamagedRequestIsTaken) {
    const std::string good = text(encode(kGo));
    for (std::size_t place = 0; place < good.size(); ++place) {
        for (int value = 0; value < 256; ++value) {
            std::string bytes = good;
            bytes[place] = static_cast<char>(value);
            if (bytes == good) continue;
            const auto events = events_in(bytes);
            const bool in_sum = place >= kFirstField && place < kEnd && value != kStx;
            const bool address_readable =
                place > kFirstField + 1 || (value >= '0' && value <= '9') || (value >= 'A' && value <= 'F');
            EXPECT_EQ(events.size(), in_sum && address_readable ? 1u : 0u) << place << ' ' << value;
            for (const auto& event : events)
                EXPECT_EQ(event.kind, EventKind::damaged) << place << ' ' << value;
        }
    }
}

TEST(MidiV24Damage, NoDamagedReplyIsBelieved) {
    const Request query{.address = 1, .index = 0x20};
    const std::string good =
        "\x06\x13" + text(encode_reply({.address = 1, .digit = 0, .data = 0x12D687})) + "\x1A";
    for (std::size_t place = 0; place < good.size(); ++place) {
        for (int value = 0; value < 256; ++value) {
            std::string bytes = good;
            bytes[place] = static_cast<char>(value);
            for (const Answer& answer : answers_in(query, bytes)) {
                const bool whole = bytes == good;
                EXPECT_NE(answer.kind, Kind::accepted) << place << ' ' << value;
                EXPECT_EQ(answer.kind == Kind::value, whole) << place << ' ' << value;
                EXPECT_EQ(answer.value, whole ? 0x12D687U : 0U) << place << ' ' << value;
            }
        }
    }
}

// A command was taken or not: what is not said plainly is not reported as either.
TEST(MidiV24Damage, ADamagedAnswerToACommandIsNoAcceptance) {
    for (const std::string answer : {"\x15", "\x06\x13\x17"}) {
        for (std::size_t place = 0; place < answer.size(); ++place) {
            for (int value = 0; value < 256; ++value) {
                std::string bytes = answer;
                bytes[place] = static_cast<char>(value);
                if (place == 2 && value == kXon) continue;  // one byte without a check: a whole other answer
                for (const Answer& heard : answers_in(kGo, bytes)) EXPECT_NE(heard.kind, Kind::accepted);
            }
        }
    }
}

TEST(MidiV24Damage, ALostOrDoubledByteIsNoRequest) {
    const std::string good = text(encode(kGo));
    for (std::size_t place = 0; place < good.size(); ++place) {
        const std::string lost = good.substr(0, place) + good.substr(place + 1);
        for (const auto& event : events_in(lost)) EXPECT_NE(event.kind, EventKind::request) << place;
        const std::string doubled = good.substr(0, place) + good[place] + good.substr(place);
        const auto events = events_in(doubled);
        // Two Stx begin the same frame; an Etx too many comes after it.
        const bool harmless = place == 0 || place == kEnd;
        EXPECT_EQ(events.size() == 1 && events[0].kind == EventKind::request, harmless) << place;
        // The next frame is understood, whatever came before.
        RequestDecoder decoder;
        feed(decoder, lost);
        const auto next = feed(decoder, good);
        ASSERT_EQ(next.size(), 1u) << place;
        EXPECT_EQ(next[0].request, kGo);
    }
}

TEST(MidiV24Damage, OtherFormsAreNoRequests) {
    // A reply; a small letter in a sum that is right otherwise (14 x 30h + 9 = 2A9h); a length of 011.
    EXPECT_TRUE(events_in(text(encode_reply({.address = 1, .digit = 0, .data = 5}))).empty());
    const auto small = events_in(framed("01401130000001111a9"));
    ASSERT_EQ(small.size(), 1u);
    EXPECT_EQ(small[0].kind, EventKind::damaged);
    EXPECT_EQ(events_in(framed("01401130000001111A9"))[0].kind, EventKind::request);
    EXPECT_TRUE(events_in(framed("0110113000000000000A5")).empty());
    EXPECT_TRUE(events_in("0014\x03").empty());
}

// The don't-care digits of 000 are digits: an x as it is printed is refused with Nack (R).
TEST(MidiV24Damage, AnXIsNoDigit) {
    const std::string fields = "01000000000000";
    std::string with_x = fields;
    with_x.back() = 'x';
    int sum = 0;
    for (const char c : with_x) sum += c;
    EXPECT_EQ(sum & 0xFF, 0xE9);  // 12 x 30h + 31h + 78h = 2E9h
    const auto events = events_in(framed("014" + with_x + "E9"));
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].kind, EventKind::damaged);
    EXPECT_EQ(events[0].request.address, 1);
}

TEST(MidiV24Damage, AbandonEndsAFrame) {
    RequestDecoder decoder;
    const std::string good = text(encode(kGo));
    feed(decoder, good.substr(0, 10));
    EXPECT_TRUE(decoder.in_frame());
    decoder.abandon();
    EXPECT_FALSE(decoder.in_frame());
    EXPECT_TRUE(feed(decoder, good.substr(10)).empty());
}

TEST(MidiV24Random, EveryRequestAndReplyComesBack) {
    constexpr unsigned kSeed = 9;
    std::mt19937 random(kSeed);
    RequestDecoder module;
    AnswerDecoder master;
    for (int i = 0; i < 50'000; ++i) {
        const Request request{.address = static_cast<std::uint8_t>(random()),
                              .index = static_cast<std::uint8_t>(random()),
                              .sub_index = static_cast<std::uint8_t>(random()),
                              .data = static_cast<std::uint32_t>(random())};
        const auto events = feed(module, text(encode(request)));
        ASSERT_EQ(events.size(), 1u) << "seed " << kSeed << ", round " << i;
        ASSERT_EQ(events[0].request, request) << "seed " << kSeed << ", round " << i;
        if (!is_query(request.index)) continue;
        master.expect(request);
        const auto data = static_cast<std::uint32_t>(random());
        const Reply reply{.address = request.address, .digit = digit_of(request.index), .data = data};
        const auto answers = feed(master, "\x06\x13" + text(encode_reply(reply)) + "\x1A");
        ASSERT_EQ(answers.size(), 1u) << "seed " << kSeed << ", round " << i;
        ASSERT_EQ(answers[0], (Answer{Kind::value, data})) << "seed " << kSeed << ", round " << i;
    }
}

}  // namespace
}  // namespace nplc::protocol::midi_v24
