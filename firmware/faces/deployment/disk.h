#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "deployment/file.h"

namespace nplc::deployment {

/// Writes files one after the other, each whole and on the disk before the next is begun, in a thread that is
/// there for as long as that takes. What another thread waits for (a stop) does not wait for a disk.
class Disk {
  public:
    Disk() = default;
    /// Waits for what is being written.
    ~Disk() { join(); }
    Disk(const Disk&) = delete;
    Disk& operator=(const Disk&) = delete;

    bool is_busy() const { return thread_.joinable(); }
    /// Not while it is busy.
    void write(std::vector<File> files);
    /// How it ended: empty, or why not, one line. Nothing: it has not, or was told already.
    std::optional<std::string> take_end();

  private:
    void join();
    void run();

    std::vector<File> files_;
    std::string error_;
    std::atomic<bool> has_ended_{false};
    std::thread thread_;
};

/// The content of a file of `most` bytes at the most. Nothing, and `is_missing`, where there is none; nothing
/// without it where it cannot be read or is longer.
std::optional<std::vector<std::uint8_t>> read_file(const std::string& path, std::size_t most,
                                                   bool& is_missing);

}  // namespace nplc::deployment
