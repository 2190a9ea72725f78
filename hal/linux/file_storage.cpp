#include "hal_linux/file_storage.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

#include "file_descriptor.h"
#include "hal_linux/whole_file.h"
#include "storage_bounds.h"

namespace nplc::hal_linux {
namespace {

namespace fs = std::filesystem;

class DiskStorage final : public FileStorage {
  public:
    DiskStorage(FileDescriptor file, const ports::StorageGeometry& geometry)
        : file_(std::move(file)), geometry_(geometry) {
        work_.reserve(geometry.erase_block);
    }

    ports::StorageGeometry geometry() const override { return geometry_; }

    base::Status read(std::uint32_t address, std::span<std::uint8_t> out) override {
        if (!is_inside(geometry_, address, out.size())) return base::Error::bad_geometry;
        const ssize_t count = ::pread(file_.get(), out.data(), out.size(), static_cast<off_t>(address));
        if (count != static_cast<ssize_t>(out.size())) return base::Error::storage_failed;
        return {};
    }

    base::Status program(std::uint32_t address, std::span<const std::uint8_t> bytes) override {
        if (!may_program(geometry_, address, bytes.size())) return base::Error::bad_geometry;
        work_.resize(bytes.size());
        if (const auto status = read(address, work_); !status) return status;
        for (std::size_t i = 0; i < bytes.size(); ++i) work_[i] = work_[i] & bytes[i];
        return write(address);
    }

    base::Status erase(std::uint32_t address) override {
        if (!may_erase(geometry_, address)) return base::Error::bad_geometry;
        work_.assign(geometry_.erase_block, 0xFF);
        return write(address);
    }

    ports::StorageState state() override {
        return failed_ ? ports::StorageState::failed : ports::StorageState::ready;
    }

  private:
    base::Status write(std::uint32_t address) {
        const ssize_t count = ::pwrite(file_.get(), work_.data(), work_.size(), static_cast<off_t>(address));
        failed_ = count != static_cast<ssize_t>(work_.size()) || ::fdatasync(file_.get()) != 0;
        return {};
    }

    FileDescriptor file_;
    ports::StorageGeometry geometry_;
    std::vector<std::uint8_t> work_;
    bool failed_ = false;
};

std::string cannot_be_made(const std::string& path, std::uint32_t size, int reason) {
    std::string said = path + ": cannot be made: " + std::strerror(reason);
    if (reason != ENOSPC && reason != EDQUOT) return said;
    return said + "; it needs " + std::to_string(size) + " bytes in " +
           fs::absolute(path).parent_path().string();
}

std::string cannot_be_opened(const std::string& path, int reason) {
    std::string said = path + ": cannot be opened: " + std::strerror(reason);
    if (reason == EROFS) said += "; mount that disk for writing; a card that is worn out becomes read-only";
    if (reason == EACCES) said += "; let this user write there";
    return said;
}

}  // namespace

FileStorage::Opened FileStorage::open(const std::string& path, const ports::StorageGeometry& geometry) {
    std::error_code error;
    const fs::file_type type = fs::symlink_status(path, error).type();
    if (type == fs::file_type::symlink)
        return {nullptr, path + ": this is a link, which is not followed; name the file itself"};
    if (type == fs::file_type::not_found &&
        !make_whole_file(path, std::vector<std::uint8_t>(geometry.size, 0xFF)))
        return {nullptr, cannot_be_made(path, geometry.size, errno)};
    FileDescriptor file(::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat status {};
    if (!file || ::fstat(file.get(), &status) != 0) return {nullptr, cannot_be_opened(path, errno)};
    if (!S_ISREG(status.st_mode) || status.st_size != static_cast<off_t>(geometry.size))
        return {nullptr, path + ": this is not a memory of " + std::to_string(geometry.size) +
                             " bytes; name another file, or remove it"};
    if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0)
        return {nullptr, path + ": another program uses this memory; end it first"};
    return {std::make_unique<DiskStorage>(std::move(file), geometry), {}};
}

bool FileStorage::is_held(const std::string& path) {
    const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    return file && ::flock(file.get(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

}  // namespace nplc::hal_linux
