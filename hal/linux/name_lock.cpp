#include "name_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <thread>

#include "port_holder.h"

namespace nplc::hal_linux {
namespace {

/// O_EXCL: a file that another user has prepared under this name is not written to.
FileDescriptor open_lock_file(const std::string& path) {
    constexpr int kFlags = O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
    for (;;) {
        FileDescriptor file(::open(path.c_str(), kFlags));
        if (file || errno != ENOENT) return file;
        file = FileDescriptor(::open(path.c_str(), kFlags | O_CREAT | O_EXCL, 0644));
        if (file || errno != EEXIST) return file;
    }
}

bool is_same(const struct stat& a, const struct stat& b) {
    return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

/// A killed program keeps its lock for a moment. False with errno.
bool lock(const FileDescriptor& file, bool at_once) {
    const int tries = at_once ? 0 : 100;
    constexpr auto kPause = std::chrono::milliseconds{5};
    for (int i = 0; ::flock(file.get(), LOCK_EX | LOCK_NB) != 0; ++i) {
        if (errno != EWOULDBLOCK || i == tries) return false;
        std::this_thread::sleep_for(kPause);
    }
    return true;
}

std::string served(const struct stat& lock, bool at_once) {
    if (at_once) return "another program serves there; end it, or name another path";
    const std::string holder = program_with([&](const struct stat& status) { return is_same(status, lock); });
    return (holder.empty() ? "this program or another user's already serves there"
                           : holder + " already serves there") +
           std::string("; end it, or name another path");
}

}  // namespace

NameLock::~NameLock() {
    if (file_) ::unlink(path_.c_str());
}

NameLock::Taken NameLock::take(const std::string& endpoint, const std::string& path, bool at_once) {
    const std::filesystem::path place(path);
    const std::string beside = place.parent_path() / ("." + place.filename().string() + ".lock");
    const std::string in_its_place = endpoint + ": " + beside;
    for (;;) {
        FileDescriptor file = open_lock_file(beside);
        struct stat opened {};
        if (!file || ::fstat(file.get(), &opened) != 0)
            return {{}, in_its_place + ": cannot be made: " + std::strerror(errno)};
        if (!S_ISREG(opened.st_mode) || opened.st_size != 0)
            return {{}, in_its_place + " is there and is no lock; remove it, or name another path"};
        if (!lock(file, at_once))
            return {{},
                    endpoint + ": " +
                        (errno == EWOULDBLOCK ? served(opened, at_once)
                                              : beside + ": cannot be locked: " + std::strerror(errno))};
        // The previous holder may have removed the file in between.
        struct stat named {};
        if (::lstat(beside.c_str(), &named) == 0 && is_same(named, opened))
            return {NameLock(std::move(file), beside), {}};
    }
}

}  // namespace nplc::hal_linux
