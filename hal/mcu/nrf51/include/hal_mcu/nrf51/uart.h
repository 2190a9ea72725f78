#pragma once

#include "hal_mcu/buffered_serial.h"

namespace nplc::hal_mcu::nrf51 {

/// The chip's UART, on any two pins; 8 bits, no parity, one stop bit. It holds six received characters.
class Uart final : public BufferedSerial {
  public:
    static constexpr unsigned kInterrupt = 2;

    struct Pins {
        std::uint8_t receive;
        std::uint8_t transmit;
    };

    void begin(const Pins& pins, std::uint32_t baud);
    void on_interrupt();

  private:
    void wake_transmitter() override;
    bool line_is_idle() override { return !sending_; }
    void send_next();

    std::atomic<bool> sending_{false};
};

}  // namespace nplc::hal_mcu::nrf51
