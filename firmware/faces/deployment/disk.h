#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "deployment/file.h"

namespace nplc::deployment {

/// Writes files in sequence, each complete and on the disk before the next, in a temporary thread. Other
/// threads (a stop) never wait for the disk.
class Disk {
  public:
    Disk() = default;
    /// Waits for the write in progress.
    ~Disk() { join(); }
    Disk(const Disk&) = delete;
    Disk& operator=(const Disk&) = delete;

    bool is_busy() const { return thread_.joinable(); }
    /// Must not be busy.
    void write(std::vector<File> files);
    /// Result of the write: empty, or a one-line error. No value: not finished, or already returned.
    std::optional<std::string> take_end();

  private:
    void join();
    void run();

    std::vector<File> files_;
    std::string error_;
    std::atomic<bool> has_ended_{false};
    std::thread thread_;
};

/// Content of a file of at most `most` bytes. No value with `is_missing`: there is no file; without it:
/// unreadable or too long.
std::optional<std::vector<std::uint8_t>> read_file(const std::string& path, std::size_t most,
                                                   bool& is_missing);

}  // namespace nplc::deployment
