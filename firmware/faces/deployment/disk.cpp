#include "disk.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "hal_linux/quiet_thread.h"
#include "hal_linux/whole_file.h"

namespace nplc::deployment {

namespace fs = std::filesystem;

void Disk::write(std::vector<File> files) {
    files_ = std::move(files);
    error_.clear();
    has_ended_ = false;
    thread_ = hal_linux::start_quiet_thread([this] { run(); });
}

void Disk::run() {
    for (const File& file : files_) {
        std::error_code ignored;
        fs::create_directories(fs::path(file.path).parent_path(), ignored);
        if (hal_linux::make_whole_file(file.path, file.bytes)) continue;
        error_ = fmt::format("{}: cannot be written: {}", file.path, std::strerror(errno));
        break;
    }
    has_ended_ = true;
}

void Disk::join() {
    if (thread_.joinable()) thread_.join();
}

std::optional<std::string> Disk::take_end() {
    if (!is_busy() || !has_ended_) return std::nullopt;
    join();
    return std::move(error_);
}

std::optional<std::vector<std::uint8_t>> read_file(const std::string& path, std::size_t most,
                                                   bool& is_missing) {
    std::error_code error;
    const auto status = fs::symlink_status(path, error);
    is_missing = status.type() == fs::file_type::not_found;
    if (!fs::is_regular_file(status)) return std::nullopt;
    std::ifstream file(path, std::ios::binary);
    std::vector<std::uint8_t> bytes(most + 1);
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!file.is_open() || file.bad() || file.gcount() > static_cast<std::streamsize>(most))
        return std::nullopt;
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
}

}  // namespace nplc::deployment
