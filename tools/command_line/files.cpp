#include "command_line/files.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "command_line/program.h"
#include "host/paths.h"

namespace nplc::command_line {

namespace fs = std::filesystem;

namespace {

/// Far more than a table or its symbols have.
constexpr std::size_t kMostBytes = 4 * 1024 * 1024;

}  // namespace

std::string read_whole(const std::string& path) {
    std::error_code error;
    if (fs::is_directory(host::path_of(path), error))
        throw UserError(fmt::format("{}: cannot be read: it is a folder", path));
    errno = 0;
    std::ifstream file(host::path_of(path), std::ios::binary);
    std::string content(kMostBytes + 1, '\0');
    file.read(content.data(), static_cast<std::streamsize>(content.size()));
    if (!file.is_open() || file.bad())
        throw UserError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
    content.resize(static_cast<std::size_t>(file.gcount()));
    if (content.size() > kMostBytes)
        throw UserError(
            fmt::format("{}: has more than {} bytes; this is none of our files", path, kMostBytes));
    return content;
}

}  // namespace nplc::command_line
