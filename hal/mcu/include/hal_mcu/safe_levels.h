#pragma once

#include <cstdint>

namespace nplc::hal_mcu {

/// The outputs' safe values in memory that a reset does not clear: used before the settings are read and
/// after a fault. After power-up the bytes are undefined; if the check word does not fit, all values are 0.
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
