#include "sim/output_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace nplc::sim {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& why) {
    throw FileError(
        fmt::format("{}: cannot be written: {}; name a file in a folder where you may write", path, why));
}

/// The end of a chain of symbolic links, also if it does not exist yet, so that a link is kept.
fs::path follow(const fs::path& path) {
    constexpr int kMostLinks = 40;
    std::error_code error;
    fs::path end = path;
    for (int i = 0; i < kMostLinks && fs::is_symlink(end, error); ++i) {
        end = end.parent_path() / fs::read_symlink(end, error);
    }
    const fs::path real = fs::weakly_canonical(fs::absolute(end, error), error);
    return error ? path : real;
}

}  // namespace

std::vector<fs::path> OutputFile::written_for(const std::string& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::exists(status) && !fs::is_regular_file(status)) return {};
    const fs::path target = follow(path);
    fs::path temporary = target;
    temporary += ".part";
    return {target, temporary};
}

OutputFile::OutputFile(const std::string& path) : path_(path) {
    std::error_code error;
    if (fs::is_directory(path, error)) fail(path, "it is a folder");
    if (error == std::errc::too_many_symbolic_link_levels) fail(path, error.message());
    const auto files = written_for(path);
    if (files.empty()) {
        stream_.open(path);
    } else {
        target_ = files[0];
        temporary_ = files[1];
        if (!fs::is_directory(fs::symlink_status(temporary_, error))) fs::remove(temporary_, error);
        errno = 0;
        stream_.open(temporary_, std::ios::out | std::ios::noreplace);
    }
    if (!stream_) fail(path, std::strerror(errno));
}

OutputFile::~OutputFile() {
    if (temporary_.empty()) return;
    stream_.close();
    std::error_code ignored;
    fs::remove(temporary_, ignored);
}

void OutputFile::write(const std::string& text) {
    stream_ << text;
    if (!stream_) fail(path_, std::strerror(errno));
}

void OutputFile::commit() {
    stream_.close();
    if (!stream_) fail(path_, std::strerror(errno));
    if (temporary_.empty()) return;
    std::error_code error;
    fs::rename(temporary_, target_, error);
    if (error) fail(path_, error.message());
    temporary_.clear();
}

}  // namespace nplc::sim
