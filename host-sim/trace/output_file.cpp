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

/// Where a chain of symbolic links ends, so that a link stays a link.
fs::path follow(const std::string& path) {
    std::error_code error;
    const fs::path real = fs::weakly_canonical(path, error);
    return error ? fs::path(path) : real;
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::is_directory(status)) fail(path, "it is a folder");
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        stream_.open(path);
    } else {
        target_ = follow(path);
        temporary_ = target_;
        temporary_ += ".part";
        stream_.open(temporary_, std::ios::trunc);
    }
    if (!stream_) fail(path, std::strerror(errno));
}

OutputFile::~OutputFile() {
    if (temporary_.empty()) return;
    stream_.close();
    std::error_code ignored;
    fs::remove(temporary_, ignored);
}

void OutputFile::commit() {
    stream_.flush();
    if (!stream_) fail(path_, std::strerror(errno));
    stream_.close();
    if (temporary_.empty()) return;
    std::error_code error;
    fs::rename(temporary_, target_, error);
    if (error) fail(path_, error.message());
    temporary_.clear();
}

}  // namespace nplc::sim
