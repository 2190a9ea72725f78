#include "hal_mcu/nrf51/pins.h"

#include <span>

#include "registers.h"

namespace nplc::hal_mcu::nrf51 {
namespace {

/// Levels of logic signals as a mask of pins.
std::uint32_t spread(std::uint32_t levels, std::span<const std::uint8_t> numbers) {
    std::uint32_t pins = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) pins |= ((levels >> i) & 1U) << numbers[i];
    return pins;
}

/// Waits until the pull-up has charged the line: some microseconds, at 16 MHz.
void let_settle() {
    for (int turn = 0; turn < 200; ++turn) asm volatile("nop");
}

}  // namespace

bool is_pulled_low(std::uint8_t pin) {
    gpio().PIN_CNF[pin] = kPinInput | kPinPullUp;
    let_settle();
    return ((gpio().IN >> pin) & 1U) == 0;
}

void InputPins::begin() {
    for (const std::uint8_t pin : numbers_) gpio().PIN_CNF[pin] = kPinInput | kPinPullDown;
}

std::uint8_t InputPins::read() {
    const std::uint32_t pins = gpio().IN;
    unsigned levels = 0;
    for (std::size_t i = 0; i < numbers_.size(); ++i) levels |= ((pins >> numbers_[i]) & 1U) << i;
    return static_cast<std::uint8_t>(levels);
}

void OutputPins::begin(std::uint8_t levels) {
    write(levels);
    for (const std::uint8_t pin : numbers_) gpio().PIN_CNF[pin] = kPinOutput;
}

/// A single store; no other code writes OUT while the firmware runs.
void OutputPins::write(std::uint8_t levels) {
    gpio().OUT = (gpio().OUT & ~spread(0xF, numbers_)) | spread(levels, numbers_);
}

}  // namespace nplc::hal_mcu::nrf51
