// A stop over the motor's own MacTalk port, with the virtual motor in virtual time.
#include "motor/mactalk_line.h"

#include <gtest/gtest.h>

#include <deque>
#include <optional>
#include <vector>

#include "sim/mac_motor.h"

namespace nplc::sim {
namespace {

using enum registers::Number;
using ByteList = std::vector<std::uint8_t>;
using base::Milliseconds;

/// 19200 baud: a character takes 521 us.
struct StoppingBench final : ports::SerialPort {
    explicit StoppingBench(registers::Model model = registers::Model::mac140)
        : motor(std::in_place, model, MacMotorOptions{.address = 1}) {
        motor->write(MODE_REG, 1);
    }

    std::size_t write(std::span<const std::uint8_t> bytes) override {
        to.insert(to.end(), bytes.begin(), bytes.end());
        return bytes.size();
    }
    std::size_t read(std::span<ports::ReceivedByte> out) override {
        std::size_t count = 0;
        for (; count < out.size() && !from.empty(); from.pop_front()) out[count++] = {from.front(), false};
        return count;
    }
    bool transmitter_idle() override { return to.empty(); }

    /// One character's time; true if the stop was confirmed in it.
    bool step(bool is_wanted = true) {
        now += base::Microseconds{521};
        if (!to.empty()) {
            if (!is_sending) began.push_back(now);
            sent.push_back(to.front());
            if (motor) motor->receive_mactalk(to.front(), false);
            to.pop_front();
        }
        is_sending = !to.empty();
        for (; motor && sample_at <= now;
             sample_at += std::chrono::ceil<base::Microseconds>(motor->sample_period()))
            motor->sample();
        const auto byte = motor ? motor->transmit_mactalk() : std::nullopt;
        if (byte && !is_deaf) from.push_back(*byte);
        return line.stop(is_wanted, now);
    }
    bool runs(base::Microseconds time) {
        for (const base::Instant end = now + time; now < end;) {
            if (step()) return true;
        }
        return false;
    }

    std::optional<MacMotor> motor;
    bool is_deaf = false;  ///< nothing of the motor arrives
    bool is_sending = false;
    std::deque<std::uint8_t> to;
    std::deque<std::uint8_t> from;
    ByteList sent;
    std::vector<base::Instant> began;  ///< messages sent
    base::Instant now{Milliseconds{1'000}};
    base::Instant sample_at = now;
    motor::MactalkLine line{*this, 1, motor->model() == registers::Model::mac800};
};

// 001 §5.1: write MODE_REG := 0 to address 1, then a read of it.
TEST(MactalkLine, StopsAMotorAndReadsThatItIsStopped) {
    StoppingBench bench;
    EXPECT_TRUE(bench.runs(Milliseconds{200}));
    for (int i = 0; i < 1'000; ++i) EXPECT_FALSE(bench.step(false));
    EXPECT_EQ(bench.motor->read(MODE_REG), 0);
    EXPECT_EQ(bench.sent, (ByteList{0x52, 0x52, 0x52, 0x01, 0xFE, 0x02, 0xFD, 0x02, 0xFD, 0x00, 0xFF, 0x00,
                                    0xFF, 0xAA, 0xAA, 0x50, 0x50, 0x50, 0x01, 0xFE, 0x02, 0xFD, 0xAA, 0xAA}));
    EXPECT_EQ(bench.line.next_poll(bench.now), base::kNever);
}

// R: a MAC800 takes longwords only.
TEST(MactalkLine, StopsAMac800ByALongword) {
    StoppingBench bench(registers::Model::mac800);
    EXPECT_TRUE(bench.runs(Milliseconds{200}));
    EXPECT_EQ(bench.motor->read(MODE_REG), 0);
    EXPECT_EQ(ByteList(bench.sent.begin() + 7, bench.sent.begin() + 19),
              (ByteList{0x04, 0xFB, 0x00, 0xFF, 0x00, 0xFF, 0x00, 0xFF, 0x00, 0xFF, 0xAA, 0xAA}));
}

TEST(MactalkLine, TalksOverNobody) {
    StoppingBench bench;
    for (int i = 0; i < 50; ++i) {
        bench.from.push_back(0xAA);
        EXPECT_FALSE(bench.runs(Milliseconds{15}));
    }
    EXPECT_TRUE(bench.sent.empty()) << "another master's characters came at most 15 ms apart";
    EXPECT_TRUE(bench.runs(Milliseconds{200}));
}

TEST(MactalkLine, RepeatsAsABlindStopDoesUntilTheMotorAnswers) {
    StoppingBench bench;
    bench.is_deaf = true;
    EXPECT_FALSE(bench.runs(Milliseconds{6'000}));
    EXPECT_EQ(bench.motor->read(MODE_REG), 0) << "it was told";
    // It waits 100 ms for each answer, which is longer than the pause of the first 20.
    ASSERT_GE(bench.began.size(), 26U);
    for (std::size_t i = 1; i < 20; ++i)
        EXPECT_LE(bench.began[i] - bench.began[i - 1], Milliseconds{125}) << i;
    EXPECT_GE(bench.began[25] - bench.began[24], Milliseconds{499});
    bench.is_deaf = false;
    EXPECT_TRUE(bench.runs(Milliseconds{700}));
}

TEST(MactalkLine, AnAcceptAloneConfirmsNothing) {
    StoppingBench bench;
    bench.motor.reset();
    for (int i = 0; i < 20; ++i) {
        bench.from.insert(bench.from.end(), 3, 0x11);
        EXPECT_FALSE(bench.runs(Milliseconds{60}));
    }
    // MODE_REG is 1.
    const ByteList moves{0x52, 0x52, 0x52, 0x00, 0xFF, 0x02, 0xFD, 0x04, 0xFB, 0x01,
                         0xFE, 0x00, 0xFF, 0x00, 0xFF, 0x00, 0xFF, 0xAA, 0xAA};
    for (int i = 0; i < 20; ++i) {
        bench.from.insert(bench.from.end(), 3, 0x11);
        EXPECT_FALSE(bench.runs(Milliseconds{20}));
        bench.from.insert(bench.from.end(), moves.begin(), moves.end());
        EXPECT_FALSE(bench.runs(Milliseconds{100}));
    }
}

TEST(MactalkLine, PassesTheUserPortsMessagesOnWhileNoStopIsWanted) {
    StoppingBench bench;
    const ByteList read{0x50, 0x50, 0x50, 0x01, 0xFE, 0x02, 0xFD, 0xAA, 0xAA};
    ports::SerialPort& user = bench.line;
    EXPECT_EQ(user.write(read), read.size());
    for (int i = 0; i < 40; ++i) EXPECT_FALSE(bench.step(false));
    std::array<ports::ReceivedByte, 32> answer;
    EXPECT_EQ(user.read(answer), 19U);
    bench.sent.clear();
    EXPECT_FALSE(bench.step());
    EXPECT_EQ(user.write(read), read.size());
    EXPECT_TRUE(bench.runs(Milliseconds{200}));
    EXPECT_EQ(bench.sent.size(), 15U + 9U) << "the stop and its read alone";
    EXPECT_EQ(user.read(answer), 0U);
}

}  // namespace
}  // namespace nplc::sim
