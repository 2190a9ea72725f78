#pragma once

#include "hal_mcu/buffered_serial.h"

namespace nplc::hal_mcu::stellaris {

/// One of the chip's UARTs (an Arm PL011), 8 bits, no parity, one stop bit.
class Uart final : public BufferedSerial {
  public:
    struct Place {
        std::uint32_t address;
        unsigned interrupt;
        std::uint32_t pin_port;
        std::uint8_t pins;  ///< both, as a mask
    };
    static constexpr Place kUart0{0x4000'C000, 5, 0x4000'4000, 0x03};   // PA0, PA1
    static constexpr Place kUart1{0x4000'D000, 6, 0x4000'7000, 0x0C};   // PD2, PD3
    static constexpr Place kUart2{0x4000'E000, 33, 0x4002'6000, 0x03};  // PG0, PG1

    explicit Uart(const Place& place);  ///< at run time, so that the flash holds no image of the buffers

    void begin(std::uint32_t baud);
    void on_interrupt();

  private:
    void wake_transmitter() override;
    bool line_is_idle() override;
    void fill_transmitter();

    Place place_;
};

}  // namespace nplc::hal_mcu::stellaris
