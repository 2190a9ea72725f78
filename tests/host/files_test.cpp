#include "host/files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

namespace nplc::host {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMost = 1000;

struct Files : testing::Test {
    Files() {
        std::string name = fs::temp_directory_path() / "files_XXXXXX";
        folder = ::mkdtemp(name.data());
    }
    ~Files() override { fs::remove_all(folder); }

    std::string with(const std::string& content) const {
        std::ofstream(folder / "file", std::ios::binary) << content;
        return folder / "file";
    }

    fs::path folder;
};

TEST_F(Files, AreReadWhole) {
    for (const std::string& content :
         {std::string(), std::string("a\0\r\n\xFF", 5), std::string(kMost, 'x')}) {
        const FileContent read = read_file(with(content), kMost);
        EXPECT_EQ(read.problem, "");
        EXPECT_EQ(read.bytes, content);
    }
}

TEST_F(Files, WhatCannotBeReadIsSaid) {
    EXPECT_EQ(read_file(folder, kMost).problem, "it is a folder");
    EXPECT_EQ(read_file(folder / "none", kMost).problem, "No such file or directory");
    EXPECT_EQ(read_file("/dev/zero", kMost).problem, "it has more than 1000 bytes");
    EXPECT_EQ(read_file("/dev/zero", std::size_t{1} << 40U).problem, "it has more than 4194304 bytes");
    const FileContent read = read_file(with(std::string(kMost + 1, 'x')), kMost);
    EXPECT_EQ(read.problem, "it has more than 1000 bytes");
    EXPECT_EQ(read.bytes, "");
}

/// 10 GB that take no room: the length alone is enough.
TEST_F(Files, OneThatIsFarTooLongIsNotRead) {
    fs::resize_file(with(""), 10'000'000'000);
    EXPECT_EQ(read_file(folder / "file", kMost).problem, "it has more than 1000 bytes");
}

TEST_F(Files, APipeIsReadToItsEndAndNeedsAWriter) {
    const std::string pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_EQ(read_file(pipe, kMost).problem, "it is a pipe, and nobody writes to it");
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    const int writer = ::open(pipe.c_str(), O_WRONLY);
    ASSERT_EQ(::write(writer, "text", 4), 4);
    ::close(writer);
    EXPECT_EQ(read_file(pipe, kMost).bytes, "text");
    ::close(reader);
}

TEST_F(Files, ANewFileReplacesNothing) {
    const std::string precious = with("precious");
    fs::create_symlink(precious, folder / "link");
    fs::create_symlink(folder / "none", folder / "dangling");
    for (const char* there : {"file", "link", "dangling", "."}) {
        EXPECT_EQ(create_file(folder / there), nullptr) << there;
        EXPECT_EQ(errno, EEXIST) << there;
    }
    EXPECT_EQ(fs::file_size(precious), 8U);
    EXPECT_FALSE(fs::exists(folder / "none"));
    std::FILE* const file = create_file(folder / "new");
    ASSERT_NE(file, nullptr);
    std::fputs("text", file);
    std::fclose(file);
    EXPECT_EQ(read_file(folder / "new", kMost).bytes, "text");
}

}  // namespace
}  // namespace nplc::host
