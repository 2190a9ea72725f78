#include <string>

#include "midi_bench.h"
#include "sim/midi_ends.h"

namespace nplc::sim {
namespace {

namespace v24 = protocol::midi_v24;
using std::chrono::milliseconds;
using std::chrono::seconds;

/// A module and its serial end, without the time of characters.
class V24Bench {
  public:
    explicit V24Bench(const MidiOptions& options) : module(midi::Model::mac34_1, options) {}

    /// What comes back, between Stx and Etx without them.
    std::string say(const std::string& bytes) {
        for (const char byte : bytes) end.receive(static_cast<std::uint8_t>(byte), false);
        std::string heard;
        while (const auto byte = end.transmit()) heard.push_back(static_cast<char>(*byte));
        return heard;
    }
    std::string ask(const v24::Request& request) {
        const v24::RequestBytes bytes = v24::encode(request);
        return say({bytes.begin(), bytes.end()});
    }

    MidiBench module;
    MidiV24End end{*module};
};

const std::string kDone = "\x06\x13\x1A";
const std::string kRefused = "\x06\x13\x17";

// 000 §II, §III; sums: 2A0h (reply 210h) and what the characters have above 30h.
TEST(MidiV24End, TheManualsAnswersInBytes) {
    V24Bench bench({.address = 1});
    EXPECT_EQ(bench.say("\x02"
                        "01401130000002710AF"
                        "\x03"),
              kDone);  // go to 10000: 2710h
    EXPECT_EQ(bench.say("\x02"
                        "01401130000002710AF"
                        "\x03"),
              kRefused);  // it moves
    EXPECT_EQ(bench.say("\x02"
                        "01401130000002710AD"
                        "\x03"),
              "\x15");  // wrong sum
    EXPECT_EQ(bench.say("\x02"
                        "01401040000000000A5"
                        "\x03"),
              kRefused);  // no such command
    EXPECT_EQ(bench.say("\x02"
                        "014012A0000000000B4"
                        "\x03"),
              kRefused);  // no such query
    bench.module.run_out();
    // 01 0 00002710: 210h + 1 + 2 + 7 + 1 = 21Bh.
    EXPECT_EQ(bench.say("\x02"
                        "01401200000000000A3"
                        "\x03"),
              "\x06\x13"
              "\x02"
              "011010000027101B"
              "\x03"
              "\x1A");
    // 01 8 80000000: 210h + 1 + 8 + 8 = 221h.
    EXPECT_EQ(bench.say("\x02"
                        "0140128AF00000000D2"
                        "\x03"),
              "\x06\x13"
              "\x02"
              "01101880000000"
              "21"
              "\x03"
              "\x1A");
}

TEST(MidiV24End, OtherModulesMessagesAreNotAnswered) {
    V24Bench bench({.address = 1});
    EXPECT_EQ(bench.ask({.address = 2, .index = 0x13, .data = 1'000}), "");
    EXPECT_FALSE(bench.module->moving());
    std::string damaged =
        "\x02"
        "01402130000002710AA"
        "\x03";
    EXPECT_EQ(bench.say(damaged), "");
}

// 000 §IV: FFh is for all; R: 00 answers.
TEST(MidiV24End, TheGeneralCommand) {
    V24Bench zero({.address = 0});
    V24Bench one({.address = 1});
    const v24::Request go{.address = v24::kGeneral, .index = 0x13, .data = 1'000};
    EXPECT_EQ(zero.ask(go), kDone);
    EXPECT_EQ(one.ask(go), "");
    EXPECT_TRUE(zero.module->moving());
    EXPECT_TRUE(one.module->moving());
    one.module.run_out();
    EXPECT_EQ(one.ask({.address = v24::kGeneral, .index = 0x20}), "");
}

// 000 §VI 08h: kept, and holds for the next message.
TEST(MidiV24End, ANewAddress) {
    V24Bench bench({.address = 0});
    EXPECT_EQ(bench.ask({.address = v24::kGeneral, .index = 0x08, .data = 5}), kDone);
    EXPECT_EQ(bench.ask({.address = 0, .index = 0x20}), "");
    EXPECT_EQ(bench.ask({.address = 5, .index = 0x09, .data = 7}), kDone);
    bench.module->power_off();
    bench.module->power_on();
    bench.module.pass(seconds{2});
    EXPECT_EQ(bench.ask({.address = 5, .index = 0x09, .data = 7}), kDone);
    EXPECT_EQ(bench.ask({.address = 5, .index = 0x08, .data = 0x80}), kRefused);
}

// 000 §VI 00h, 01h: answered, then deaf for two seconds.
TEST(MidiV24End, TwoDeafSeconds) {
    for (const std::uint8_t index : {std::uint8_t{0x00}, std::uint8_t{0x01}}) {
        V24Bench bench({.address = 0});
        const v24::Request position{.index = 0x20};
        EXPECT_EQ(bench.ask({.index = index}), kDone);
        bench.module.pass(seconds{2} - kTick);
        EXPECT_EQ(bench.ask(position), "");
        bench.module.pass(kTick);
        EXPECT_EQ(bench.ask(position).size(), 3u + 18u);
    }
    // A frame that begins in the two seconds is none.
    V24Bench bench({.address = 0});
    bench.ask({.index = 0});
    const v24::RequestBytes bytes = v24::encode({.index = 0x20});
    const std::string frame(bytes.begin(), bytes.end());
    EXPECT_EQ(bench.say(frame.substr(0, 10)), "");
    bench.module.pass(seconds{2});
    EXPECT_EQ(bench.say(frame.substr(10)), "");
    EXPECT_EQ(bench.say(frame).size(), 21u);
}

// 000 §VI 1Bh: kept; answered at the old rate, since the module restarts behind it.
TEST(MidiV24End, ANewBaudRate) {
    V24Bench bench({.address = 0});
    const v24::RequestBytes bytes = v24::encode({.index = 0x1B, .data = 1});
    for (const std::uint8_t byte : bytes) bench.end.receive(byte, false);
    EXPECT_EQ(bench.module->baud(), 38'400U);
    std::string heard;
    while (const auto byte = bench.end.transmit()) {
        EXPECT_EQ(bench.module->baud(), heard.size() < 2 ? 38'400U : 9'600U);
        heard.push_back(static_cast<char>(*byte));
    }
    EXPECT_EQ(heard, kDone);
    bench.module->power_off();
    bench.module->power_on();
    EXPECT_EQ(bench.module->baud(), 9'600U);
}

TEST(MidiV24End, AFramingErrorDropsTheFrame) {
    V24Bench bench({.address = 0});
    const v24::RequestBytes bytes = v24::encode({.index = 0x20});
    for (std::size_t i = 0; i < bytes.size(); ++i) bench.end.receive(bytes[i], i == 7);
    EXPECT_FALSE(bench.end.transmit());
}

}  // namespace
}  // namespace nplc::sim
