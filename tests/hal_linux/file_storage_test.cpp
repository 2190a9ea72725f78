#include "hal_linux/file_storage.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "store_bench.h"

namespace nplc::hal_linux {
namespace {

namespace fs = std::filesystem;
using store::Bytes;

constexpr std::uint32_t kSize = 8 * 4096;
constexpr ports::StorageGeometry kFileGeometry{
    .size = kSize, .erase_block = 4096, .program_page = 256, .program_unit = 1};

struct FileStorageTest : testing::Test {
    FileStorageTest() {
        std::string folder = fs::temp_directory_path() / "file_storage_XXXXXX";
        folder_ = ::mkdtemp(folder.data());
        path = folder_ / "flash";
    }
    ~FileStorageTest() override { fs::remove_all(folder_); }

    std::unique_ptr<FileStorage> open() const {
        auto opened = FileStorage::open(path, kFileGeometry);
        EXPECT_EQ(opened.error, "");
        return std::move(opened.storage);
    }

    fs::path folder_;
    std::string path;
};

TEST_F(FileStorageTest, IsBlankAtFirstAndKeepsWhatWasProgrammed) {
    {
        const auto storage = open();
        Bytes bytes(kSize);
        ASSERT_TRUE(storage->read(0, bytes).ok());
        EXPECT_EQ(bytes, Bytes(kSize, 0xFF));
        ASSERT_TRUE(storage->program(4096 + 250, Bytes{1, 2, 0xF0}).ok());
        EXPECT_EQ(storage->state(), ports::StorageState::ready);
    }
    EXPECT_EQ(fs::file_size(path), kSize);
    const auto storage = open();
    Bytes bytes(4);
    ASSERT_TRUE(storage->read(4096 + 250, bytes).ok());
    EXPECT_EQ(bytes, (Bytes{1, 2, 0xF0, 0xFF}));
    ASSERT_TRUE(storage->program(4096 + 252, Bytes{0x0F}).ok());
    ASSERT_TRUE(storage->read(4096 + 250, bytes).ok());
    EXPECT_EQ(bytes[2], 0) << "only ones become zeros";
    ASSERT_TRUE(storage->erase(4096).ok());
    ASSERT_TRUE(storage->read(4096 + 250, bytes).ok());
    EXPECT_EQ(bytes, Bytes(4, 0xFF));
}

TEST_F(FileStorageTest, HoldsAStoreOfTables) {
    const store::Area area{.begin = 0, .slot_bytes = 3 * 4096};
    const Bytes table = store::table_of(1000, 7);
    for (int start = 0; start < 2; ++start) {
        const auto storage = open();
        store::TableCheck check;
        store::Slots slots(*storage, area, store::Kind::table, check);
        ASSERT_TRUE(slots.mount().ok());
        EXPECT_EQ(slots.has_current(), start == 1);
        if (start == 1) {
            Bytes bytes(9000);
            EXPECT_EQ(slots.load(bytes).value(), table.size());
            EXPECT_TRUE(std::equal(table.begin(), table.end(), bytes.begin()));
            continue;
        }
        ASSERT_TRUE(slots.begin().ok());
        while (slots.phase() == store::Phase::erasing) slots.poll();
        for (std::uint32_t at = 0; at < table.size();) {
            if (slots.write(at, std::span(table).subspan(at, 8))) at += 8;
            slots.poll();
        }
        ASSERT_TRUE(slots.finish(static_cast<std::uint32_t>(table.size()), base::crc32(table)).ok());
        while (slots.phase() == store::Phase::closing) slots.poll();
        EXPECT_EQ(slots.phase(), store::Phase::done);
    }
}

TEST_F(FileStorageTest, RefusesWhatDoesNotFit) {
    const auto storage = open();
    Bytes bytes(2);
    EXPECT_EQ(storage->read(kSize - 1, bytes).error(), base::Error::bad_geometry);
    EXPECT_EQ(storage->program(255, bytes).error(), base::Error::bad_geometry) << "over a page's end";
    EXPECT_EQ(storage->program(0, {}).error(), base::Error::bad_geometry);
    EXPECT_EQ(storage->erase(1).error(), base::Error::bad_geometry);
    EXPECT_EQ(storage->erase(kSize).error(), base::Error::bad_geometry);
}

TEST_F(FileStorageTest, WhatIsNoMemoryOrInUseIsLeftAsItIs) {
    std::ofstream(path) << "precious";
    EXPECT_NE(FileStorage::open(path, kFileGeometry).error.find("not a memory of 32768 bytes"),
              std::string::npos);
    EXPECT_EQ(fs::file_size(path), 8U);
    EXPECT_NE(FileStorage::open(folder_, kFileGeometry).error, "");
    EXPECT_NE(FileStorage::open(folder_ / "no/such", kFileGeometry).error.find("cannot be made"),
              std::string::npos);
    fs::create_symlink(path, folder_ / "link");
    EXPECT_NE(FileStorage::open(folder_ / "link", kFileGeometry).error.find("this is a link"),
              std::string::npos);
    fs::remove(path);
    EXPECT_NE(FileStorage::open(folder_ / "link", kFileGeometry).error.find("this is a link"),
              std::string::npos);
    const auto first = open();
    EXPECT_NE(FileStorage::open(path, kFileGeometry).error.find("another program uses"), std::string::npos);
}

/// The name under which a memory is made first can be known before.
TEST_F(FileStorageTest, WhatIsPreparedUnderTheFirstNameIsNotWrittenTo) {
    const fs::path victim = folder_ / "victim";
    std::ofstream(victim) << "precious";
    fs::create_symlink(victim, path + "." + std::to_string(::getpid()));
    const auto storage = open();
    EXPECT_EQ(fs::file_size(victim), 8U);
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(path)));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 2);
}

}  // namespace
}  // namespace nplc::hal_linux
