#include "hal_mcu/stellaris/pins.h"

#include <span>

#include "registers.h"

namespace nplc::hal_mcu::stellaris {
namespace {

GpioRegisters& at(std::uint32_t port) {
    return block<GpioRegisters>(port);
}

/// Levels of logic signals as a mask of pins.
std::uint32_t spread(std::uint32_t levels, std::span<const std::uint8_t> numbers) {
    std::uint32_t pins = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) pins |= ((levels >> i) & 1U) << numbers[i];
    return pins;
}

}  // namespace

void connect_to_peripheral(std::uint32_t port, std::uint8_t pins) {
    auto& gpio = at(port);
    gpio.AFSEL = gpio.AFSEL | pins;
    gpio.DEN = gpio.DEN | pins;
}

void InputPins::begin() {
    auto& gpio = at(port_);
    const std::uint32_t pins = spread(0x3F, numbers_);
    gpio.DIR = gpio.DIR & ~pins;
    gpio.PDR = gpio.PDR | pins;
    gpio.DEN = gpio.DEN | pins;
}

std::uint8_t InputPins::read() {
    const std::uint32_t pins = at(port_).DATA[spread(0x3F, numbers_)];
    unsigned levels = 0;
    for (std::size_t i = 0; i < numbers_.size(); ++i) levels |= ((pins >> numbers_[i]) & 1U) << i;
    return static_cast<std::uint8_t>(levels);
}

/// The chip ignores the levels of pins that are inputs, so they are written again when they are outputs.
void OutputPins::begin(std::uint8_t levels) {
    auto& gpio = at(port_);
    const std::uint32_t pins = spread(0xF, numbers_);
    write(levels);
    gpio.DIR = gpio.DIR | pins;
    write(levels);
    gpio.DEN = gpio.DEN | pins;
}

void OutputPins::write(std::uint8_t levels) {
    at(port_).DATA[spread(0xF, numbers_)] = spread(levels, numbers_);
}

}  // namespace nplc::hal_mcu::stellaris
