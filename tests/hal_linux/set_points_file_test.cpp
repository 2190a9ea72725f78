// The file that the Linux board keeps set-points in: each bit of it flipped at rest, and a disk that takes no
// more.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include <sys/resource.h>

#include "hal_linux/file_storage.h"
#include "store/set_points.h"

namespace nplc::hal_linux {
namespace {

namespace fs = std::filesystem;
using store::SetPointStore;

/// As firmware/boards/linux has them, at the file's beginning.
constexpr std::uint32_t kSlot = 2048;
constexpr ports::StorageGeometry kMemory{
    .size = 2 * kSlot, .erase_block = 2048, .program_page = 256, .program_unit = 8};
constexpr store::Area kArea{.begin = 0, .slot_bytes = kSlot};

struct SetPointFile : testing::Test {
    SetPointFile() {
        std::string folder = fs::temp_directory_path() / "set_points_XXXXXX";
        folder_ = ::mkdtemp(folder.data());
        path = folder_ / "store.bin";
        storage = FileStorage::open(path, kMemory).storage;
    }
    ~SetPointFile() override { fs::remove_all(folder_); }

    /// `value` in the wanted set and in a recipe.
    bool save(std::int32_t value) {
        SetPointStore kept(*storage, kArea);
        EXPECT_TRUE(kept.mount());
        kept.image().wanted().clear();
        kept.image().wanted().add({.name_hash = 1, .value = value, .unit = 2});
        kept.image().recipe(1)[0] = 'A';
        kept.image().values_of(1).copy_from(kept.image().wanted());
        if (!kept.save()) return false;
        for (int i = 0; i < 1000 && kept.is_saving(); ++i) kept.poll();
        return kept.phase() == store::Phase::done;
    }
    struct Found {
        bool is_sound = false;
        std::vector<std::uint8_t> bytes;
    };
    Found look() {
        SetPointStore kept(*storage, kArea);
        const bool is_sound = kept.mount().ok();
        return {is_sound, {kept.image().bytes().begin(), kept.image().bytes().end()}};
    }

    fs::path folder_;
    std::string path;
    std::unique_ptr<FileStorage> storage;
};

TEST_F(SetPointFile, EachFlippedBitLeavesTheNewSetOrSaysThatTheOldOneStandsIn) {
    ASSERT_TRUE(save(100));
    const std::vector<std::uint8_t> old = look().bytes;
    ASSERT_TRUE(save(200));
    const std::vector<std::uint8_t> newest = look().bytes;
    ASSERT_NE(old, newest);
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    const auto put = [&](std::uint32_t at, char byte) {
        file.seekp(at);
        file.put(byte).flush();
    };
    std::size_t said = 0;
    for (std::uint32_t at = 0; at < kMemory.size; ++at) {
        file.seekg(at);
        const char whole = static_cast<char>(file.get());
        for (unsigned bit = 0; bit < 8; ++bit) {
            put(at, static_cast<char>(whole ^ 1 << bit));
            const Found found = look();
            const bool stands_in = found.bytes == old;
            ASSERT_TRUE(found.bytes == newest || stands_in) << "bit " << bit << " of byte " << at;
            ASSERT_TRUE(!found.is_sound || !stands_in)
                << "bit " << bit << " of byte " << at << " is not noticed";
            said += stands_in ? 1U : 0U;
        }
        put(at, whole);
    }
    // Header of 24 bytes, content and mark of 8 of the newest one.
    EXPECT_GE(said, 8 * (24 + newest.size() + 8));
    EXPECT_TRUE(look().is_sound);
    EXPECT_EQ(look().bytes, newest);
}

/// The kernel lets no byte beyond the first slot be written, as a disk without room for it would.
TEST_F(SetPointFile, AWriteThatTheDiskRefusesLeavesTheOldSet) {
    ASSERT_TRUE(save(100));
    const std::vector<std::uint8_t> old = look().bytes;
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit full{kSlot, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &full), 0);
    const bool stored = save(200);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, ignored);
    EXPECT_FALSE(stored);
    EXPECT_TRUE(look().is_sound);
    EXPECT_EQ(look().bytes, old);
    EXPECT_TRUE(save(200));
}

}  // namespace
}  // namespace nplc::hal_linux
