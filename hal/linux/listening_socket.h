#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <string>
#include <utility>

#include "file_descriptor.h"
#include "hal_linux/byte_server.h"
#include "name_lock.h"

namespace nplc::hal_linux {

/// The path of a socket in the file system, removed by the destructor unless it is another socket by then.
class BoundPath {
  public:
    BoundPath() = default;
    BoundPath(NameLock lock, std::string path) : lock_(std::move(lock)), path_(std::move(path)) {
        ::lstat(path_.c_str(), &bound_);
    }
    BoundPath(BoundPath&& other) noexcept
        : lock_(std::move(other.lock_)), path_(std::exchange(other.path_, {})), bound_(other.bound_) {}
    BoundPath& operator=(BoundPath&&) = delete;
    ~BoundPath() {
        struct stat there {};
        if (path_.empty() || ::lstat(path_.c_str(), &there) != 0) return;
        if (there.st_dev == bound_.st_dev && there.st_ino == bound_.st_ino) ::unlink(path_.c_str());
    }

  private:
    NameLock lock_;
    std::string path_;
    struct stat bound_ {};
};

/// A listening socket.
struct ListeningSocket {
    FileDescriptor descriptor{};
    std::string name{};   ///< as a client writes it
    BoundPath path{};     ///< for a socket in the file system
    std::string error{};  ///< one line, if there is no socket
};
ListeningSocket listen_at_path(const std::string& path, const ByteServer::Settings& settings);
/// `where`: ADDRESS:PORT
ListeningSocket listen_at_port(const std::string& where);

/// Without Nagle's delay and non-blocking; empty if no client is connecting.
FileDescriptor accept_client(const FileDescriptor& listener);

}  // namespace nplc::hal_linux
