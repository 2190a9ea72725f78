#include "midi_rack.h"

#include <gtest/gtest.h>

#include <string>

namespace nplc::sim {
namespace {

namespace midi = registers::midi;
namespace v24 = protocol::midi_v24;
using std::chrono::milliseconds;
using std::chrono::seconds;

Time characters(std::int64_t count, std::int64_t baud) {
    return Time{count * 10'000'000'000 / baud};
}

std::string ask(MidiRack& rack, const v24::Request& request, Time time = milliseconds{100}) {
    rack.received();
    rack.send(v24::encode(request));
    rack.advance(rack.now() + time);
    const auto bytes = rack.received();
    return {bytes.begin(), bytes.end()};
}

const std::string kAnswered = "\x06\x13\x1A";

// 21 characters there and 21 back (Ack, Xoff, 18 of the reply, Xon).
TEST(MidiRack, AQueryTakesItsTimeOnTheLine) {
    for (const std::uint8_t code : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3}}) {
        MidiRack rack({{midi::Model::mac34_1, 0}}, 0);
        MidiMemory memory = rack.module(0).memory();
        memory.baud_code = code;
        rack.module(0).set_memory(memory);
        rack.send(v24::encode({.index = 0x20}));
        std::size_t got = 0;
        while (got < 21 && rack.now() < seconds{1}) {
            rack.advance(rack.now() + milliseconds{1});
            got += rack.received().size();
        }
        EXPECT_EQ(got, 21u);
        EXPECT_GE(rack.now(), characters(42, midi::baud_of(code)));
        EXPECT_LE(rack.now(), characters(42, midi::baud_of(code)) + milliseconds{2});
    }
}

TEST(MidiRack, EachModuleAnswersForItself) {
    MidiRack rack({{midi::Model::mac23, 0}, {midi::Model::mac34_2, 1}}, 0);
    EXPECT_EQ(ask(rack, {.address = 1, .index = 0x09, .data = 7}), kAnswered);
    EXPECT_EQ(rack.module(0).memory().upper_stop, midi::kMaxPosition);
    EXPECT_EQ(rack.module(1).memory().upper_stop, 7);
    EXPECT_EQ(ask(rack, {.address = v24::kGeneral, .index = 0x09, .data = 8}), kAnswered);
    EXPECT_EQ(rack.module(0).memory().upper_stop, 8);
    EXPECT_EQ(rack.module(1).memory().upper_stop, 8);
    EXPECT_EQ(ask(rack, {.address = 2, .index = 0x20}), "");
}

// 000 §VI 1Bh: a client that stays at 38400 is not understood any more; one that goes along is.
TEST(MidiRack, AnotherBaudRate) {
    for (const std::uint32_t client : {38'400U, 0U}) {
        MidiRack rack({{midi::Model::mac34_1, 0}}, client);
        EXPECT_EQ(ask(rack, {.index = 0x1B, .data = 1}), kAnswered);
        EXPECT_EQ(ask(rack, {.index = 0x20}, seconds{1}), "");
        rack.advance(rack.now() + seconds{1});
        EXPECT_EQ(ask(rack, {.index = 0x20}).size(), client == 0 ? 21u : 0u);
        EXPECT_EQ(rack.baud(), client == 0 ? 9'600U : 38'400U);
    }
}

TEST(MidiRack, TheSameCallsGiveTheSameBytes) {
    const auto run = [] {
        MidiRack rack({{midi::Model::mac23, 0}, {midi::Model::mac34_1, 1}}, 0);
        std::string all = ask(rack, {.address = v24::kGeneral, .index = 0x13, .data = 5'000});
        for (int i = 0; i < 100; ++i) {
            const auto address = static_cast<std::uint8_t>(i % 3);
            all += ask(rack, {.address = address, .index = 0x20}, std::chrono::microseconds{1 + 997 * i});
        }
        return all;
    };
    EXPECT_EQ(run(), run());
}

TEST(MidiRack, AClientThatFloodsLosesBytesAndNothingElse) {
    MidiRack rack({{midi::Model::mac34_1, 0}}, 0);
    rack.send(std::vector<std::uint8_t>(200'000, '0'));
    rack.advance(seconds{18});  // 64 KiB at 3840 a second
    EXPECT_EQ(ask(rack, {.index = 0x20}).size(), 21u);
}

}  // namespace
}  // namespace nplc::sim
