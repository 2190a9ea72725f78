#include "hal_linux/background_storage.h"

#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <semaphore>
#include <thread>

#include "store_bench.h"

namespace nplc::hal_linux {
namespace {

using ports::StorageState;
using store::Bytes;

constexpr ports::StorageGeometry kGeometry{
    .size = 8 * 4096, .erase_block = 4096, .program_page = 256, .program_unit = 1};

/// Completes each operation only when the test permits it, as a slow card does.
class SlowStorage final : public ports::Storage {
  public:
    ports::StorageGeometry geometry() const override { return memory.geometry(); }
    base::Status read(std::uint32_t address, std::span<std::uint8_t> out) override {
        return memory.read(address, out);
    }
    base::Status program(std::uint32_t address, std::span<const std::uint8_t> bytes) override {
        begun.release();
        allowed.acquire();
        return memory.program(address, bytes);
    }
    base::Status erase(std::uint32_t address) override {
        begun.release();
        allowed.acquire();
        return memory.erase(address);
    }
    StorageState state() override { return memory.state(); }

    sim::SimStorage memory{kGeometry, 0};
    std::counting_semaphore<> begun{0};
    std::counting_semaphore<> allowed{0};
};

struct BackgroundStorageTest : testing::Test {
    /// What it is when it is no longer busy.
    StorageState end() {
        while (storage->state() == StorageState::busy) std::this_thread::yield();
        return storage->state();
    }
    Bytes bytes(std::uint32_t address, std::size_t count) {
        Bytes all(count);
        EXPECT_TRUE(storage->read(address, all).ok());
        return all;
    }

    SlowStorage slow;
    std::optional<BackgroundStorage> storage{slow};
};

TEST_F(BackgroundStorageTest, NobodyWaitsForASlowStorage) {
    ASSERT_EQ(storage->state(), StorageState::ready);
    ASSERT_TRUE(storage->program(256, Bytes{1, 2, 3}).ok());
    slow.begun.acquire();
    EXPECT_EQ(storage->state(), StorageState::busy);
    Bytes some(3);
    EXPECT_EQ(storage->read(256, some).error(), base::Error::busy);
    EXPECT_EQ(storage->program(512, some).error(), base::Error::busy);
    EXPECT_EQ(storage->erase(0).error(), base::Error::busy);
    slow.allowed.release();
    EXPECT_EQ(end(), StorageState::ready);
    EXPECT_EQ(bytes(256, 4), (Bytes{1, 2, 3, 0xFF}));
    slow.allowed.release();
    ASSERT_TRUE(storage->erase(0).ok());
    EXPECT_EQ(end(), StorageState::ready);
    EXPECT_EQ(bytes(256, 3), Bytes(3, 0xFF));
}

TEST_F(BackgroundStorageTest, TheBytesNeedNotStay) {
    Bytes gone{7, 8, 9};
    ASSERT_TRUE(storage->program(0, gone).ok());
    slow.begun.acquire();
    gone.assign(3, 0);
    slow.allowed.release();
    EXPECT_EQ(end(), StorageState::ready);
    EXPECT_EQ(bytes(0, 3), (Bytes{7, 8, 9}));
}

TEST_F(BackgroundStorageTest, AFailureIsTold) {
    slow.memory.fail_operation(0);
    slow.allowed.release(2);
    ASSERT_TRUE(storage->erase(4096).ok());
    EXPECT_EQ(end(), StorageState::failed);
    ASSERT_TRUE(storage->erase(4096).ok()) << "the next one may be begun";
    EXPECT_EQ(end(), StorageState::ready);
}

TEST_F(BackgroundStorageTest, WhatDoesNotFitIsRefusedAtOnce) {
    EXPECT_EQ(storage->program(255, Bytes{1, 2}).error(), base::Error::bad_geometry) << "over a page's end";
    EXPECT_EQ(storage->program(0, {}).error(), base::Error::bad_geometry);
    EXPECT_EQ(storage->erase(1).error(), base::Error::bad_geometry);
    EXPECT_EQ(storage->erase(8 * 4096).error(), base::Error::bad_geometry);
    EXPECT_EQ(storage->state(), StorageState::ready);
}

TEST_F(BackgroundStorageTest, ItsEndWaitsForTheOperationUnderWay) {
    ASSERT_TRUE(storage->program(0, Bytes{5}).ok());
    slow.begun.acquire();
    std::atomic<bool> ended = false;
    std::thread ending([&] {
        storage.reset();
        ended = true;
    });
    EXPECT_FALSE(ended);
    slow.allowed.release();
    ending.join();
    Bytes byte(1);
    ASSERT_TRUE(slow.memory.read(0, byte).ok());
    EXPECT_EQ(byte, Bytes{5});
}

TEST_F(BackgroundStorageTest, HoldsAStoreOfTables) {
    slow.allowed.release(1000);
    const store::Area area{.begin = 0, .slot_bytes = 3 * 4096};
    const Bytes table = store::table_of(1000, 7);
    store::TableCheck check;
    store::Slots slots(*storage, area, store::Kind::table, check);
    ASSERT_TRUE(slots.mount().ok());
    ASSERT_TRUE(slots.begin().ok());
    while (slots.phase() == store::Phase::erasing) slots.poll();
    for (std::uint32_t at = 0; at < table.size();) {
        if (slots.write(at, std::span(table).subspan(at, 8))) at += 8;
        slots.poll();
    }
    ASSERT_TRUE(slots.finish(static_cast<std::uint32_t>(table.size()), base::crc32(table)).ok());
    while (slots.phase() == store::Phase::closing) slots.poll();
    ASSERT_EQ(slots.phase(), store::Phase::done);
    Bytes read(9000);
    ASSERT_EQ(slots.load(read).value(), table.size());
    EXPECT_TRUE(std::equal(table.begin(), table.end(), read.begin()));
}

}  // namespace
}  // namespace nplc::hal_linux
