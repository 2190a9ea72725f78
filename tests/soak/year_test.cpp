// A year of a machine that stands: what happens is a press of a button now and then, a table stored every
// month, and clocks that wrap. The rest is skipped over, as a board does that sleeps until its next deadline.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "port_bench.h"
#include "random_tables.h"

namespace nplc::soak {
namespace {

using namespace std::chrono_literals;
using gateway::PortBench;
namespace reg = registers::gateway;

/// IN0 on: an order, OUT0, 150 ms on the timer, step 1; timer 0 there: the order back, step 2; IN0 off: step
/// 0.
constexpr std::array<std::uint8_t, 32> kTable{
    0xC0, 0x01, 0x01, 0x01, 0x41, 0x01, 0x96, 0x00, 0x41, 0x00, 0x00, 0x02, 0x40, 0x00, 0x00, 0x00,
    0xC2, 0x00, 0x01, 0x00, 0x80, 0x00, 0x00, 0x00, 0x3F, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00};
constexpr std::uint8_t kOut = 0x41;
constexpr std::uint8_t kBack = 0x40;

class StandingMachine : private PortBench {
  public:
    explicit StandingMachine(std::uint64_t seed) : dice_(seed) {
        only_when_due = true;
        EXPECT_TRUE(upload_and_activate(kTable));
        EXPECT_TRUE(command(reg::Command::run));
        begun_ = board.now - base::Milliseconds(gateway->uptime());
    }

    /// False if something that must hold did not.
    void stand(base::Microseconds length) {
        const base::Instant end = board.now + length;
        base::Instant next_month = board.now + std::chrono::days(30);
        while (board.now < end && !testing::Test::HasFailure()) {
            sleep(base::Microseconds(60'000'000) * (1 + dice_.below(6 * 60)));
            press();
            if (board.now < next_month) continue;
            next_month += std::chrono::days(30);
            store_again();
        }
    }
    /// To just before a multiple of `period`, of the board's clock or of the gateway's uptime, and presses
    /// beyond it.
    void cross(base::Microseconds period, bool of_uptime) {
        const auto passed = (of_uptime ? board.now - begun_ : board.now.time_since_epoch()) % period;
        sleep(period - passed - base::Microseconds(60'000));
        press();
        ++crossings_;
    }

    unsigned presses() const { return presses_; }
    unsigned stores() const { return stores_; }
    unsigned crossings() const { return crossings_; }
    std::uint32_t uptime_wraps() const { return wraps_; }

  private:
    /// From deadline to deadline.
    void sleep(base::Microseconds time) {
        const base::Instant end = board.now + time;
        while (board.now < end) step(end);
        check();
    }

    void press() {
        const base::Instant pressed = board.now;
        board.room = 8;
        board.in = 1;
        run(100ms);
        EXPECT_EQ(board.out, 1U) << "OUT0 within debounce and scan";
        sleep(200ms);
        board.in = 0;
        run(100ms);
        ASSERT_EQ(board.sent.size(), 2U) << "pressed at " << pressed.time_since_epoch().count() << " us";
        EXPECT_EQ(board.sent[0].command, kOut);
        EXPECT_EQ(board.sent[1].command, kBack) << "after 150 ms of the timer";
        EXPECT_EQ(gateway->state().step, 0U);
        board.sent.clear();
        board.scans_seen.clear();
        board.accesses.clear();
        ++presses_;
    }

    void store_again() {
        EXPECT_TRUE(upload(kTable));
        EXPECT_EQ(tables->stored().crc, base::crc32(kTable));
        EXPECT_FALSE(tables->fell_back());
        ++stores_;
    }

    void check() {
        using registers::gateway::RunState;
        EXPECT_EQ(gateway->run_state(), RunState::running);
        EXPECT_EQ(gateway->safe_reason(), gateway::SafeReason::none);
        EXPECT_EQ(gateway->polls().late(), 0U);
        const auto milliseconds = std::chrono::duration_cast<base::Milliseconds>(board.now - begun_).count();
        EXPECT_LE(gateway->uptime() - static_cast<std::uint32_t>(milliseconds), 1U) << "modulo 2^32";
        wraps_ = static_cast<std::uint32_t>(milliseconds >> 32);
    }

    property::Dice dice_;
    base::Instant begun_{};
    unsigned presses_ = 0;
    unsigned stores_ = 0;
    unsigned crossings_ = 0;
    std::uint32_t wraps_ = 0;
};

TEST(Year, OfAStandingMachine) {
    constexpr std::uint64_t kSeed = 1;
    SCOPED_TRACE("seed " + std::to_string(kSeed));
    const auto machine = std::make_unique<StandingMachine>(kSeed);
    machine->stand(std::chrono::days(365));
    fmt::print("{} presses, {} tables stored, uptime wrapped {} times\n", machine->presses(),
               machine->stores(), machine->uptime_wraps());
    EXPECT_GT(machine->presses(), 2'000U);
    EXPECT_EQ(machine->stores(), 12U);
    EXPECT_EQ(machine->uptime_wraps(), 7U) << "365 days are 7.3 times 2^32 ms";
}

/// Half of what a press sets off comes before the wrap, half behind it.
TEST(Year, PressesAcrossTheWrapsOfMicrosecondsAndMilliseconds) {
    constexpr std::int64_t kWord = std::int64_t{1} << 32;
    const auto machine = std::make_unique<StandingMachine>(2);
    for (int i = 0; i < 50 && !testing::Test::HasFailure(); ++i)
        machine->cross(base::Microseconds(kWord), false);
    for (int i = 0; i < 3 && !testing::Test::HasFailure(); ++i)
        machine->cross(base::Milliseconds(kWord), true);
    EXPECT_EQ(machine->crossings(), 53U);
    EXPECT_EQ(machine->uptime_wraps(), 3U);
}

}  // namespace
}  // namespace nplc::soak
