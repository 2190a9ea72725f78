#include "hal_mcu/i2c_memory.h"

#include <gtest/gtest.h>

#include <vector>

namespace nplc::hal_mcu {
namespace {

using ports::StorageState;

/// A memory with a write cycle in which it acknowledges nothing; each look at the bus takes 100 us.
class Memory final : public I2cBus, public ports::Clock {
  public:
    void begin(const Transfer& transfer) override {
        ++transfers;
        const bool acknowledges = there && transfer.device == 0x50 && time >= cycle_ends;
        looks_left_ = stuck ? -1 : 2;
        end_ = acknowledges ? State::idle : State::refused;
        if (!acknowledges) return;
        const std::size_t address = transfer.address[0] * 256U + transfer.address[1];
        for (std::size_t i = 0; i < transfer.out.size(); ++i) bytes.at(address + i) = transfer.out[i];
        for (std::size_t i = 0; i < transfer.blanks; ++i) bytes.at(address + i) = 0xFF;
        for (std::size_t i = 0; i < transfer.in.size(); ++i) transfer.in[i] = bytes.at(address + i);
        if (!transfer.out.empty() || transfer.blanks != 0) cycle_ends = time + base::Milliseconds(5);
    }
    State state() override {
        time += base::Microseconds(100);
        if (looks_left_ == 0) return end_;
        if (looks_left_ > 0) --looks_left_;
        return State::busy;
    }
    void abandon() override {
        ++abandoned;
        looks_left_ = 0;
        end_ = State::idle;
    }
    base::Instant now() override { return time; }

    std::vector<std::uint8_t> bytes = std::vector<std::uint8_t>(32 * 1024, 0x55);
    base::Instant time{};
    base::Instant cycle_ends{};
    bool there = true;
    bool stuck = false;
    int transfers = 0;
    int abandoned = 0;

  private:
    int looks_left_ = 0;
    State end_ = State::idle;
};

StorageState wait(I2cMemory& storage) {
    for (int i = 0; i < 10'000; ++i) {
        if (storage.state() != StorageState::busy) break;
    }
    return storage.state();
}

struct Bench {
    Memory memory;
    I2cMemory storage{memory, memory, I2cMemory::k24C256};
};

TEST(I2cMemory, HasTheGeometryOfAnEeprom) {
    Bench bench;
    const auto geometry = bench.storage.geometry();
    EXPECT_EQ(geometry.size, 32'768U);
    EXPECT_EQ(geometry.erase_block, 64U);
    EXPECT_EQ(geometry.program_page, 64U);
    EXPECT_EQ(geometry.program_unit, 1U);
}

TEST(I2cMemory, ErasesAPageAndProgramsInIt) {
    Bench bench;
    ASSERT_TRUE(bench.storage.erase(0x1240).ok());
    EXPECT_EQ(wait(bench.storage), StorageState::ready);
    const std::vector<std::uint8_t> bytes{1, 2, 3};
    ASSERT_TRUE(bench.storage.program(0x127D, bytes).ok());
    EXPECT_EQ(wait(bench.storage), StorageState::ready);
    std::vector<std::uint8_t> back(66);
    ASSERT_TRUE(bench.storage.read(0x123F, back).ok());
    EXPECT_EQ(back[0], 0x55);
    EXPECT_EQ(back[1], 0xFF);
    EXPECT_EQ(back[61], 0xFF);
    EXPECT_EQ(back[62], 1);
    EXPECT_EQ(back[64], 3);
    EXPECT_EQ(back[65], 0x55);
}

TEST(I2cMemory, IsBusyUntilItsWriteCycleIsOver) {
    Bench bench;
    const base::Instant begun = bench.memory.time;
    ASSERT_TRUE(bench.storage.erase(0).ok());
    std::vector<std::uint8_t> byte(1);
    EXPECT_EQ(bench.storage.read(0, byte).error(), base::Error::busy);
    EXPECT_EQ(bench.storage.program(0, byte).error(), base::Error::busy);
    EXPECT_EQ(bench.storage.erase(0).error(), base::Error::busy);
    EXPECT_EQ(wait(bench.storage), StorageState::ready);
    EXPECT_GE(bench.memory.time - begun, base::Milliseconds(5));
    EXPECT_TRUE(bench.storage.read(0, byte).ok());
}

TEST(I2cMemory, RefusesWhatDoesNotFit) {
    Bench bench;
    std::vector<std::uint8_t> bytes(64);
    EXPECT_EQ(bench.storage.erase(1).error(), base::Error::bad_geometry);
    EXPECT_EQ(bench.storage.erase(32'768).error(), base::Error::bad_geometry);
    EXPECT_EQ(bench.storage.program(1, bytes).error(), base::Error::bad_geometry);
    EXPECT_EQ(bench.storage.program(32'768, bytes).error(), base::Error::bad_geometry);
    EXPECT_EQ(bench.storage.read(32'705, bytes).error(), base::Error::bad_geometry);
    EXPECT_EQ(bench.storage.read(0xFFFF'FFFF, bytes).error(), base::Error::bad_geometry);
    EXPECT_EQ(bench.memory.transfers, 0);
}

TEST(I2cMemory, FailsWithoutAMemoryAndWorksOnceItIsThere) {
    Bench bench;
    bench.memory.there = false;
    std::vector<std::uint8_t> byte(1);
    EXPECT_FALSE(bench.storage.wait_until_ready());
    EXPECT_EQ(bench.storage.read(0, byte).error(), base::Error::storage_failed);
    ASSERT_TRUE(bench.storage.erase(0).ok());
    EXPECT_EQ(wait(bench.storage), StorageState::failed);
    bench.memory.there = true;
    ASSERT_TRUE(bench.storage.erase(0).ok());
    EXPECT_EQ(wait(bench.storage), StorageState::ready);
}

TEST(I2cMemory, GivesUpABusThatHangsAndAMemoryThatNeverEndsItsCycle) {
    Bench bench;
    bench.memory.stuck = true;
    std::vector<std::uint8_t> byte(1);
    EXPECT_EQ(bench.storage.read(0, byte).error(), base::Error::storage_failed);
    EXPECT_EQ(bench.memory.abandoned, 1);
    ASSERT_TRUE(bench.storage.erase(0).ok());
    EXPECT_EQ(wait(bench.storage), StorageState::failed);
    EXPECT_EQ(bench.memory.abandoned, 2);
    bench.memory.stuck = false;
    ASSERT_TRUE(bench.storage.erase(0).ok());
    bench.memory.cycle_ends = bench.memory.time + base::Milliseconds(1'000);
    EXPECT_EQ(wait(bench.storage), StorageState::failed);
}

TEST(I2cMemory, WaitsAtTheStartForAWriteCycleThatAResetCutOff) {
    Bench bench;
    bench.memory.cycle_ends = base::Instant(base::Milliseconds(5));
    EXPECT_TRUE(bench.storage.wait_until_ready());
    EXPECT_GE(bench.memory.time, bench.memory.cycle_ends);
}

}  // namespace
}  // namespace nplc::hal_mcu
