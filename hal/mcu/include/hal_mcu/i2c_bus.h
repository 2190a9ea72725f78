#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace nplc::hal_mcu {

/// A chip's I2C master, one transfer at a time. Nothing blocks. A hung bus may stay busy: the caller needs a
/// timeout.
class I2cBus {
  public:
    enum class State : std::uint8_t {
        idle,  ///< the last transfer is complete
        busy,
        refused,  ///< no acknowledge, or arbitration lost
    };

    /// Writes device and address, then `out`, then `blanks` times FFh, then a stop. With `in`, a repeated
    /// start and a read follow. The bytes must stay valid until the state is no longer busy.
    struct Transfer {
        std::uint8_t device = 0;  ///< 7 bits
        std::array<std::uint8_t, 2> address{};
        std::uint8_t blanks = 0;
        std::span<const std::uint8_t> out{};
        std::span<std::uint8_t> in{};
    };

    /// Needs a state other than busy.
    virtual void begin(const Transfer& transfer) = 0;
    virtual State state() = 0;
    /// Aborts the transfer and frees the bus.
    virtual void abandon() = 0;

  protected:
    ~I2cBus() = default;
};

}  // namespace nplc::hal_mcu
