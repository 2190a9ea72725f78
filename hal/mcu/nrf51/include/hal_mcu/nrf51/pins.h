#pragma once

#include <array>
#include <cstdint>

#include "ports/digital_io.h"

namespace nplc::hal_mcu::nrf51 {

/// Reads a button or strap between a pin and ground.
bool is_pulled_low(std::uint8_t pin);

/// Six pins, high = active; pulled down, so that an open terminal is off.
class InputPins final : public ports::DigitalInputs {
  public:
    constexpr explicit InputPins(const std::array<std::uint8_t, 6>& numbers) : numbers_(numbers) {}
    void begin();
    std::uint8_t read() override;

  private:
    std::array<std::uint8_t, 6> numbers_;
};

/// Four pins, high = active, all changed at once.
class OutputPins final : public ports::DigitalOutputs {
  public:
    constexpr explicit OutputPins(const std::array<std::uint8_t, 4>& numbers) : numbers_(numbers) {}
    /// Sets these levels when the pins become outputs.
    void begin(std::uint8_t levels);
    void write(std::uint8_t levels) override;

  private:
    std::array<std::uint8_t, 4> numbers_;
};

}  // namespace nplc::hal_mcu::nrf51
