#pragma once

#include <string>

#include "file_descriptor.h"

namespace nplc::hal_linux {

/// One program at a time serves at a path. Held by a lock on an empty file beside it, `.NAME.lock`, which is
/// removed with this object; the kernel drops the lock of a program that was killed.
class NameLock {
  public:
    struct Taken;
    /// For the path of this endpoint; `endpoint` names it in messages. Waits half a second for one that is
    /// taken, unless `at_once`.
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
    std::string error;  ///< who serves there, or why nobody can; empty when it was taken
};

}  // namespace nplc::hal_linux
