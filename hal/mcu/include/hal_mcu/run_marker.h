#pragma once

#include <cstdint>

namespace nplc::hal_mcu {

/// A marker of the running firmware in memory that a reset does not clear: if it is set at a start, the
/// previous run was ended by an unexpected reset. After power-up the bytes are undefined; a flipped bit does
/// not hide a set marker.
class RunMarker {
  public:
    bool is_set() const { return running_ == kRunning || check_ == ~kRunning; }
    void set() {
        running_ = kRunning;
        check_ = ~kRunning;
    }
    void clear() { running_ = check_ = 0; }

  private:
    static constexpr std::uint32_t kRunning = 0x5255'4E53;  // "RUNS"

    std::uint32_t running_;
    std::uint32_t check_;
};

}  // namespace nplc::hal_mcu
