#include "hal_linux/run_marker.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/crc32.h"

namespace nplc::hal_linux {
namespace {

namespace fs = std::filesystem;
using Found = RunMarker::Found;

struct RunMarkerTest : testing::Test {
    RunMarkerTest() {
        std::string folder = fs::temp_directory_path() / "run_marker_XXXXXX";
        folder_ = ::mkdtemp(folder.data());
        path = folder_ / "running";
    }
    ~RunMarkerTest() override { fs::remove_all(folder_); }

    Found found() const { return RunMarker(path).found(); }
    std::string content() const {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    void write(const std::string& text) const { std::ofstream(path, std::ios::binary) << text; }

    fs::path folder_;
    std::string path;
};

TEST_F(RunMarkerTest, SaysHowTheLastRunEnded) {
    EXPECT_EQ(found(), Found::missing);
    EXPECT_EQ(RunMarker(path).make(), "");
    EXPECT_EQ(found(), Found::fresh);
    RunMarker marker(path);
    EXPECT_EQ(marker.set(), "");
    EXPECT_EQ(found(), Found::running);
    EXPECT_TRUE(RunMarker(path).of_this_boot());
    EXPECT_EQ(marker.note_crash(), "");
    EXPECT_EQ(found(), Found::crashed);
    EXPECT_EQ(marker.clear(), "");
    EXPECT_EQ(found(), Found::ended);
    EXPECT_TRUE(RunMarker(path).of_this_boot());
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1)
        << "nothing is left beside it";
}

TEST_F(RunMarkerTest, KeepsItsSizeAndItsPlaceOnTheDisk) {
    struct stat before {};
    struct stat after {};
    RunMarker marker(path);
    ASSERT_EQ(marker.make(), "");
    ASSERT_EQ(::stat(path.c_str(), &before), 0);
    ASSERT_EQ(marker.set(), "");
    ASSERT_EQ(::stat(path.c_str(), &after), 0);
    EXPECT_EQ(after.st_ino, before.st_ino);
    EXPECT_EQ(after.st_size, before.st_size);
}

TEST_F(RunMarkerTest, OfAnEarlierBoot) {
    const std::string checked = "running 01234567-89ab-cdef-0123-456789abcdef ";
    std::array<char, 9> crc{};
    std::snprintf(
        crc.data(), crc.size(), "%08x",
        static_cast<unsigned>(base::crc32(std::vector<std::uint8_t>(checked.begin(), checked.end()))));
    write(checked + crc.data() + "\n");
    EXPECT_EQ(found(), Found::running);
    EXPECT_FALSE(RunMarker(path).of_this_boot());
}

TEST_F(RunMarkerTest, AFlippedBitOrACutIsDamage) {
    ASSERT_EQ(RunMarker(path).set(), "");
    const std::string sound = content();
    for (std::size_t bit = 0; bit < 8 * sound.size(); ++bit) {
        std::string damaged = sound;
        damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
        write(damaged);
        EXPECT_EQ(found(), Found::damaged) << bit;
    }
    for (std::size_t size = 0; size < sound.size(); ++size) {
        write(sound.substr(0, size));
        EXPECT_EQ(found(), Found::damaged) << size;
    }
    write(sound + "\n");
    EXPECT_EQ(found(), Found::damaged);
    EXPECT_EQ(RunMarker(path).set(), "") << "it is written anew";
    EXPECT_EQ(content(), sound);
}

TEST_F(RunMarkerTest, WhatIsNoFileIsDamageAndDoesNotBlock) {
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    EXPECT_EQ(found(), Found::damaged);
    EXPECT_EQ(RunMarker(path).set(), "");
    EXPECT_EQ(found(), Found::running);
    fs::remove(path);
    fs::create_symlink("/dev/full", path);
    EXPECT_EQ(found(), Found::damaged);
    EXPECT_EQ(RunMarker(path).set(), "");
    EXPECT_EQ(found(), Found::running);
    fs::remove(path);
    fs::create_directories(path + "/in_the_way");
    EXPECT_EQ(found(), Found::damaged);
    EXPECT_TRUE(RunMarker(path).set().starts_with(path + ": cannot be written: "));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

/// No file of this program may grow beyond so much.
struct FileLimit {
    explicit FileLimit(rlim_t most) {
        std::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{.rlim_cur = most, .rlim_max = before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }
    rlimit before_{};
};

TEST_F(RunMarkerTest, ThatItCannotBeWrittenIsSaid) {
    RunMarker marker(path);
    ASSERT_EQ(marker.make(), "");
    std::string in_place;
    std::string new_one;
    {
        const FileLimit limit(10);
        in_place = marker.set();
        new_one = RunMarker(path + "2").set();
    }
    EXPECT_NE(in_place, "");
    EXPECT_EQ(found(), Found::damaged) << "half of it was written";
    EXPECT_NE(new_one, "");
    EXPECT_FALSE(fs::exists(path + "2"));
    EXPECT_EQ(marker.set(), "");
    EXPECT_EQ(found(), Found::running);
}

TEST_F(RunMarkerTest, ThatItsFolderIsGoneIsSaid) {
    RunMarker marker(path);
    ASSERT_EQ(marker.set(), "");
    fs::remove_all(folder_);
    EXPECT_EQ(marker.clear(), path + ": cannot be written: No such file or directory");
}

}  // namespace
}  // namespace nplc::hal_linux
