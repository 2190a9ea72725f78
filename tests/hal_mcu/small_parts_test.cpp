#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "hal_mcu/crash_record.h"
#include "hal_mcu/interrupt_ring.h"
#include "hal_mcu/run_marker.h"
#include "hal_mcu/safe_levels.h"
#include "hal_mcu/tick_time.h"

namespace nplc::hal_mcu {
namespace {

using base::Instant;
using base::Microseconds;

TEST(InterruptRing, KeepsOrderAndItsCapacityWhileItsCountersWrap) {
    InterruptRing<std::uint32_t, 4> ring;
    for (std::uint32_t i = 0; i < 70'000; i += 4) {
        for (std::uint32_t k = 0; k < 4; ++k) EXPECT_TRUE(ring.push(i + k));
        EXPECT_FALSE(ring.push(0));
        EXPECT_EQ(ring.size(), 4U);
        for (std::uint32_t k = 0; k < 4; ++k) EXPECT_EQ(ring.pop(), i + k);
        EXPECT_TRUE(ring.empty());
        EXPECT_EQ(ring.pop(), std::nullopt);
    }
}

TEST(TickTime, GoesOnWhenTheMillisecondsWrap) {
    TickTime time;
    EXPECT_EQ(time.at(0xFFFF'FFFE, 999), Instant(Microseconds(4'294'967'294'999)));
    EXPECT_EQ(time.at(0xFFFF'FFFF, 1), Instant(Microseconds(4'294'967'295'001)));
    EXPECT_EQ(time.at(0, 0), Instant(Microseconds(4'294'967'296'000)));
    EXPECT_EQ(time.at(7, 5), Instant(Microseconds(4'294'967'303'005)));
}

/// The counter has wrapped and its interrupt is still pending: the sum is a millisecond short.
TEST(TickTime, NeverRunsBack) {
    TickTime time;
    EXPECT_EQ(time.at(5, 999), Instant(Microseconds(5'999)));
    EXPECT_EQ(time.at(5, 3), Instant(Microseconds(5'999)));
    EXPECT_EQ(time.at(6, 4), Instant(Microseconds(6'004)));
}

TEST(CrashRecord, IsKnownFromWhatMemoryHoldsAfterPowerUp) {
    CrashRecord record{};
    EXPECT_FALSE(record.valid());
    record.set(EndCause::bus_fault, 0x1234);
    CrashRecord kept = record;
    EXPECT_TRUE(kept.valid());
    EXPECT_EQ(kept.cause(), EndCause::bus_fault);
    EXPECT_EQ(kept.code_address(), 0x1234U);
    kept.clear();
    EXPECT_FALSE(kept.valid());
    EXPECT_EQ(kept.cause(), EndCause::none);
}

TEST(SafeLevels, AreAllOffUntilTheyWereKept) {
    SafeLevels levels{};
    EXPECT_EQ(levels.get(), 0U);
    levels.set(0b1010);
    const SafeLevels kept = levels;
    EXPECT_EQ(kept.get(), 0b1010U);
}

TEST(RunMarker, IsClearInWhatMemoryHoldsAfterPowerUp) {
    RunMarker marker{};
    EXPECT_FALSE(marker.is_set());
    marker.set();
    RunMarker kept = marker;
    EXPECT_TRUE(kept.is_set());
    kept.clear();
    EXPECT_FALSE(kept.is_set());
}

TEST(RunMarker, AFlippedBitHidesNothing) {
    static_assert(sizeof(RunMarker) == 8);
    for (unsigned bit = 0; bit < 64; ++bit) {
        RunMarker marker{};
        marker.set();
        std::array<std::uint8_t, sizeof marker> bytes;
        std::memcpy(bytes.data(), &marker, sizeof marker);
        bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1U << bit % 8));
        std::memcpy(&marker, bytes.data(), sizeof marker);
        EXPECT_TRUE(marker.is_set()) << bit;
    }
}

}  // namespace
}  // namespace nplc::hal_mcu
