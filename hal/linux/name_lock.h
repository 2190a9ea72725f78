#pragma once

#include <string>

#include "file_descriptor.h"

namespace nplc::hal_linux {

/// At most one server per path. Held by a lock on an empty file beside it, `.NAME.lock`, which is removed
/// with this object; the kernel drops the lock of a killed program.
class NameLock {
  public:
    struct Taken;
    /// `path` of the endpoint; `endpoint` is its name in messages. Waits up to half a second for a lock that
    /// is held, unless `at_once`.
    static Taken take(const std::string& endpoint, const std::string& path, bool at_once);

    NameLock() = default;
    NameLock(NameLock&& other) noexcept = default;
    NameLock& operator=(NameLock&&) = delete;
    ~NameLock();

  private:
    NameLock(FileDescriptor file, std::string path) : file_(std::move(file)), path_(std::move(path)) {}

    FileDescriptor file_;
    std::string path_;
};

struct NameLock::Taken {
    NameLock lock;
    std::string error;  ///< which program serves there, or another error; empty on success
};

}  // namespace nplc::hal_linux
