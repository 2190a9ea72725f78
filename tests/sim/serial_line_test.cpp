#include "sim/serial_line.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace nplc::sim {
namespace {

using namespace std::chrono_literals;

constexpr std::uint32_t kBaud = 19'200;

/// Sends `count` characters back to back and takes each as it arrives.
std::vector<ports::ReceivedByte> send_all(LineDirection& line, int count) {
    std::vector<ports::ReceivedByte> received;
    Time now{0};
    for (int i = 0; i < count; ++i) {
        line.start(static_cast<std::uint8_t>(i), now);
        now = line.busy_until();
        while (const auto byte = line.take(now)) received.push_back(*byte);
    }
    while (const auto byte = line.take(now + 1s)) received.push_back(*byte);
    return received;
}

TEST(SerialLine, AtUnlikeRatesNoCharacterArrivesAsItWas) {
    LineDirection line(kBaud, 1);
    line.set_rates(38'400, kBaud);
    const auto received = send_all(line, 100);
    ASSERT_EQ(received.size(), 100U);
    for (std::size_t i = 0; i < received.size(); ++i) {
        EXPECT_TRUE(received[i].framing_error);
        EXPECT_NE(received[i].value, i);
    }
    LineDirection same(kBaud, 1);
    same.set_rates(38'400, 38'400);
    EXPECT_FALSE(send_all(same, 1).front().framing_error);
    EXPECT_EQ(same.busy_until(), Time(260'416)) << "10 bits at 38400 baud";
}

TEST(SerialLine, ACharacterLastsTenBits) {
    LineDirection line(kBaud, 1);
    line.start(0x55, Time(1000));
    // 10 bits / 19200 per second = 520833.33 ns
    EXPECT_EQ(line.busy_until(), Time(1000 + 520'833));
    EXPECT_EQ(line.next_arrival(), Time(1000 + 520'833));
    EXPECT_FALSE(line.take(Time(1000 + 520'832)).has_value());
    const auto byte = line.take(Time(1000 + 520'833));
    ASSERT_TRUE(byte.has_value());
    EXPECT_EQ(byte->value, 0x55);
    EXPECT_FALSE(byte->framing_error);
}

TEST(SerialLine, TheRateDoesNotDrift) {
    LineDirection line(kBaud, 1);
    Time now{0};
    for (int i = 0; i < 1920 * 60; ++i) {
        line.start(0, now);
        now = line.busy_until();
        line.take(now);
    }
    EXPECT_EQ(now, Time(60s));  // 1920 characters a second
}

TEST(SerialLine, APauseStartsTheRateAnew) {
    LineDirection line(kBaud, 1);
    line.start(0, Time(0));
    line.start(0, Time(1ms));
    EXPECT_EQ(line.busy_until(), Time(1ms) + Time(520'833));
}

TEST(SerialLine, AGoodLineDeliversEverythingInOrder) {
    LineDirection line(kBaud, 1);
    const auto received = send_all(line, 256);
    ASSERT_EQ(received.size(), 256U);
    for (std::size_t i = 0; i < received.size(); ++i) EXPECT_EQ(received[i].value, i);
}

TEST(SerialLine, FaultsComeInTheSharesAskedFor) {
    LineDirection line(kBaud, 7);
    line.set_faults({.drop = 0.01, .damage = 0.02, .framing = 0.03, .delay = 0.04});
    constexpr int kCount = 100'000;
    send_all(line, kCount);
    const LineCounters& seen = line.counters();
    // Within 5 sigma of a binomial: sigma is sqrt(n p (1 - p)), at the most 62 here.
    EXPECT_EQ(seen.sent, 100'000U);
    EXPECT_NEAR(static_cast<double>(seen.dropped), 1000, 160);
    EXPECT_NEAR(static_cast<double>(seen.framing), 0.99 * 3000, 275);
    EXPECT_NEAR(static_cast<double>(seen.damaged), 0.99 * 0.97 * 2000, 220);
    EXPECT_NEAR(static_cast<double>(seen.delayed), 0.99 * 4000, 315);
    EXPECT_EQ(seen.delivered, seen.sent - seen.dropped);
}

TEST(SerialLine, DamageChangesTheCharacter) {
    LineDirection line(kBaud, 7);
    line.set_faults({.damage = 1});
    const auto received = send_all(line, 200);
    ASSERT_EQ(received.size(), 200U);
    for (std::size_t i = 0; i < received.size(); ++i) EXPECT_NE(received[i].value, i);
}

TEST(SerialLine, FramingErrorsAreMarked) {
    LineDirection line(kBaud, 7);
    line.set_faults({.framing = 1});
    for (const auto& byte : send_all(line, 20)) EXPECT_TRUE(byte.framing_error);
}

TEST(SerialLine, TheSeedDecides) {
    const auto run = [](std::uint64_t seed) {
        LineDirection line(kBaud, seed);
        line.set_faults({.drop = 0.5});
        std::vector<std::uint8_t> values;
        for (const auto& byte : send_all(line, 64)) values.push_back(byte.value);
        return values;
    };
    EXPECT_EQ(run(3), run(3));
    EXPECT_NE(run(3), run(4));
}

TEST(SerialLine, OneFaultDoesNotMoveAnothersVictims) {
    const auto dropped = [](double damage) {
        LineDirection line(kBaud, 9);
        line.set_faults({.drop = 0.3, .damage = damage});
        send_all(line, 500);
        return line.counters().dropped;
    };
    EXPECT_EQ(dropped(0), dropped(0.9));
}

TEST(SerialLine, DelayedCharactersNeverOvertake) {
    LineDirection line(kBaud, 5);
    line.set_faults({.delay = 0.3, .longest_delay = 20ms});
    const auto received = send_all(line, 256);
    ASSERT_EQ(received.size(), 256U);
    for (std::size_t i = 0; i < received.size(); ++i) EXPECT_EQ(received[i].value, i);
    EXPECT_GT(line.counters().delayed, 0U);
}

TEST(SerialLine, ACutLosesWhatIsUnderWayAndWhatFollows) {
    LineDirection line(kBaud, 1);
    line.start(1, Time(0));
    line.cut();
    EXPECT_FALSE(line.take(Time(1s)).has_value());
    line.start(2, Time(1s));
    line.restore();
    EXPECT_FALSE(line.take(Time(2s)).has_value());
    line.start(3, Time(2s));
    const auto byte = line.take(Time(3s));
    ASSERT_TRUE(byte.has_value());
    EXPECT_EQ(byte->value, 3);
    EXPECT_EQ(line.counters().cut, 2U);
}

TEST(SerialLine, ThePortSendsOneCharacterAfterTheOther) {
    VirtualSerialLine line(kBaud, 1);
    const std::array<std::uint8_t, 2> bytes{0xE0, 0x63};
    EXPECT_TRUE(line.port().transmitter_idle());
    EXPECT_EQ(line.port().write(bytes), 2U);
    EXPECT_FALSE(line.port().transmitter_idle());
    line.service(Time(0));
    const Time first = line.to_motor().busy_until();
    line.service(first);
    const Time second = line.to_motor().busy_until();
    EXPECT_EQ(second, Time(1'041'666));  // two characters
    EXPECT_FALSE(line.port().transmitter_idle());
    line.service(second);
    EXPECT_TRUE(line.port().transmitter_idle());
    EXPECT_EQ(line.to_motor().take(second)->value, 0xE0);
    EXPECT_EQ(line.to_motor().take(second)->value, 0x63);
}

TEST(SerialLine, ThePortTakesWhatItsBufferHolds) {
    VirtualSerialLine line(kBaud, 1);
    const std::vector<std::uint8_t> bytes(100, 0);
    EXPECT_EQ(line.port().write(bytes), 64U);
    EXPECT_EQ(line.port().write(bytes), 0U);
}

TEST(SerialLine, ThePortHandsOverWhatArrived) {
    VirtualSerialLine line(kBaud, 1);
    line.from_motor().start(0x10, Time(0));
    EXPECT_FALSE(line.service(Time(1000)));
    EXPECT_TRUE(line.service(Time(520'833)));
    std::array<ports::ReceivedByte, 4> out{};
    ASSERT_EQ(line.port().read(out), 1U);
    EXPECT_EQ(out[0].value, 0x10);
    EXPECT_EQ(line.port().read(out), 0U);
}

}  // namespace
}  // namespace nplc::sim
