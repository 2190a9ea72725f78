#include "hal_mcu/stellaris/uart.h"

#include "hal_mcu/cortex_m/core.h"
#include "hal_mcu/stellaris/pins.h"
#include "hal_mcu/stellaris/system_clock.h"
#include "registers.h"

namespace nplc::hal_mcu::stellaris {
namespace {

UartRegisters& at(std::uint32_t address) {
    return block<UartRegisters>(address);
}

}  // namespace

Uart::Uart(const Place& place) : place_(place) {}

/// The divider has six bits of fraction: 64 * clock / (16 * baud), rounded. An interrupt comes after two
/// characters, or 32 bit times after the last one.
void Uart::begin(std::uint32_t baud) {
    auto& uart = at(place_.address);
    connect_to_peripheral(place_.pin_port, place_.pins);
    uart.IM = 0;
    uart.CTL = 0;
    uart.LCRH = 0;  // empties the chip's buffers
    const std::uint32_t divider = (8 * kHertz / baud + 1) / 2;
    uart.IBRD = divider / 64;
    uart.FBRD = divider % 64;
    uart.LCRH = kLcrh8Bits | kLcrhFifo;
    uart.IFLS = 0;
    uart.ICR = 0x7FF;
    uart.IM = kImReceive | kImReceiveTimeout | kImOverrun;
    uart.CTL = kCtlEnable;
    // A buffer that already has characters might never interrupt.
    while ((uart.FR & kFrReceiverEmpty) == 0) static_cast<void>(uart.DR);
    cortex_m::enable_interrupt(place_.interrupt);
}

void Uart::on_interrupt() {
    auto& uart = at(place_.address);
    const std::uint32_t causes = uart.MIS;
    uart.ICR = causes & ~kImTransmit;
    while ((uart.FR & kFrReceiverEmpty) == 0) {
        const std::uint32_t data = uart.DR;
        if ((data & kDrOverrun) != 0) note_overrun();
        take_received(static_cast<std::uint8_t>(data), (data & (kDrFraming | kDrBreak)) != 0);
    }
    if ((causes & kImTransmit) == 0) return;
    uart.ICR = kImTransmit;
    fill_transmitter();
    if (!has_to_send()) uart.IM = uart.IM & ~kImTransmit;
}

/// The interrupt comes when the chip's buffer runs low, so it must be filled first.
void Uart::wake_transmitter() {
    auto& uart = at(place_.address);
    uart.IM = uart.IM & ~kImTransmit;
    fill_transmitter();
    if (has_to_send()) uart.IM = uart.IM | kImTransmit;
}

void Uart::fill_transmitter() {
    auto& uart = at(place_.address);
    while ((uart.FR & kFrTransmitterFull) == 0) {
        const auto byte = next_to_send();
        if (!byte) return;
        uart.DR = *byte;
    }
}

bool Uart::line_is_idle() {
    return (at(place_.address).FR & kFrBusy) == 0;
}

}  // namespace nplc::hal_mcu::stellaris
