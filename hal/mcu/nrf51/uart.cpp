#include "hal_mcu/nrf51/uart.h"

#include "hal_mcu/cortex_m/core.h"
#include "registers.h"

namespace nplc::hal_mcu::nrf51 {
namespace {

/// Register / 2^32 = baud / 16 MHz, in steps of 1000h.
constexpr std::uint32_t divider_of(std::uint32_t baud) {
    constexpr std::uint32_t kClock = 15'625;                      // 16 MHz, in units of 1024 Hz
    const std::uint32_t units = ((baud << 11) / kClock + 1) / 2;  // of 2^12
    return units << 12;
}
static_assert(divider_of(1'200) == 0x0004'F000 && divider_of(9'600) == 0x0027'5000);
static_assert(divider_of(19'200) == 0x004E'A000 && divider_of(115'200) == 0x01D7'E000);
static_assert(divider_of(921'600) == 0x0EBE'E000);

}  // namespace

/// The line must be high before the UART controls the pin.
void Uart::begin(const Pins& pins, std::uint32_t baud) {
    uart().ENABLE = 0;
    gpio().OUTSET = 1U << pins.transmit;
    gpio().PIN_CNF[pins.transmit] = kPinOutput;
    gpio().PIN_CNF[pins.receive] = kPinInput | kPinPullUp;
    uart().PSELTXD = pins.transmit;
    uart().PSELRXD = pins.receive;
    uart().BAUDRATE = divider_of(baud);
    uart().CONFIG = 0;
    uart().ENABLE = kUartEnable;
    uart().EVENTS_RXDRDY = 0;
    uart().EVENTS_TXDRDY = 0;
    uart().EVENTS_ERROR = 0;
    uart().INTENSET = kUartReceived | kUartSent | kUartError;
    uart().TASKS_STARTTX = 1;
    uart().TASKS_STARTRX = 1;
    cortex_m::enable_interrupt(kInterrupt);
}

/// The chip does not report which character was bad: the buffered ones are marked, or else the next position.
void Uart::on_interrupt() {
    bool bad = false;
    if (uart().EVENTS_ERROR != 0) {
        uart().EVENTS_ERROR = 0;
        const std::uint32_t errors = uart().ERRORSRC;
        uart().ERRORSRC = errors;
        bad = (errors & (kUartFraming | kUartBreak)) != 0;
        if ((errors & kUartOverrun) != 0 || uart().EVENTS_RXDRDY == 0) note_overrun();
    }
    while (uart().EVENTS_RXDRDY != 0) {
        uart().EVENTS_RXDRDY = 0;  // before the character is read, which brings the next
        take_received(static_cast<std::uint8_t>(uart().RXD), bad);
    }
    if (uart().EVENTS_TXDRDY == 0) return;
    uart().EVENTS_TXDRDY = 0;
    send_next();
}

/// For the loop only; excludes the interrupt while it checks and sends.
void Uart::wake_transmitter() {
    uart().INTENCLR = kUartSent;
    if (!sending_) send_next();
    uart().INTENSET = kUartSent;
}

void Uart::send_next() {
    const auto byte = next_to_send();
    sending_ = byte.has_value();
    if (byte) uart().TXD = *byte;
}

}  // namespace nplc::hal_mcu::nrf51
