#pragma once

#include <cstdint>

namespace nplc::hal_mcu {

/// The outputs' safe values in memory that a reset does not clear: for what happens before the settings are
/// read and when nothing works any more. After power-up the bytes are anything, so a check is held against
/// them; then all are 0.
class SafeLevels {
  public:
    std::uint8_t get() const { return check_ == ~levels_ ? static_cast<std::uint8_t>(levels_ & 0xFU) : 0; }
    void set(std::uint8_t levels) {
        levels_ = levels;
        check_ = ~levels_;
    }

  private:
    std::uint32_t levels_;
    std::uint32_t check_;
};

}  // namespace nplc::hal_mcu
