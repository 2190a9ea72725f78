#pragma once

#include <cstdint>

namespace nplc::hal_mcu {

/// Says in memory that a reset does not clear that the firmware runs: whoever finds it set at the start knows
/// that the run before was ended by a reset that nobody announced. After power-up the bytes are anything;
/// a bit that has flipped hides nothing.
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
