#include "hal_linux/whole_file.h"

#include <fcntl.h>

#include <cerrno>
#include <filesystem>

#include "file_descriptor.h"

namespace nplc::hal_linux {
namespace {

/// A nearly full disk first accepts a part of the data.
bool write_all(const FileDescriptor& file, std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(file.get(), bytes.data(), bytes.size());
        if (count <= 0) return false;
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return ::fsync(file.get()) == 0;
}

}  // namespace

bool make_whole_file(const std::string& path, std::span<const std::uint8_t> bytes) {
    const std::string temporary = path + "." + std::to_string(::getpid());
    ::unlink(temporary.c_str());
    const FileDescriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
    if (!file) return false;
    if (!write_all(file, bytes) || ::rename(temporary.c_str(), path.c_str()) != 0) {
        const int reason = errno;
        ::unlink(temporary.c_str());
        errno = reason;
        return false;
    }
    const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
    const FileDescriptor parent(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    return parent && ::fsync(parent.get()) == 0;
}

bool overwrite(const std::string& path, std::span<const std::uint8_t> bytes, std::uint32_t offset) {
    const FileDescriptor file(::open(path.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (!file) return false;
    const ssize_t count = ::pwrite(file.get(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
    const bool is_whole = count == static_cast<ssize_t>(bytes.size());
    if (count >= 0 && !is_whole) errno = ENOSPC;
    return is_whole && ::fdatasync(file.get()) == 0;
}

}  // namespace nplc::hal_linux
