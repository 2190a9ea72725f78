#pragma once

#include <array>
#include <cstdint>

#include "ports/digital_io.h"

namespace nplc::hal_mcu::stellaris {

inline constexpr std::uint32_t kPortB = 0x4000'5000;
inline constexpr std::uint32_t kPortD = 0x4000'7000;

/// Assigns pins to a peripheral of the chip.
void connect_to_peripheral(std::uint32_t port, std::uint8_t pins);

/// Six pins of one port, high = active; pulled down, so that an open terminal is off.
class InputPins final : public ports::DigitalInputs {
  public:
    constexpr InputPins(std::uint32_t port, const std::array<std::uint8_t, 6>& numbers)
        : port_(port), numbers_(numbers) {}
    void begin();
    std::uint8_t read() override;

  private:
    std::uint32_t port_;
    std::array<std::uint8_t, 6> numbers_;
};

/// Four pins of one port, high = active, all changed at once.
class OutputPins final : public ports::DigitalOutputs {
  public:
    constexpr OutputPins(std::uint32_t port, const std::array<std::uint8_t, 4>& numbers)
        : port_(port), numbers_(numbers) {}
    /// Sets these levels when the pins become outputs.
    void begin(std::uint8_t levels);
    void write(std::uint8_t levels) override;

  private:
    std::uint32_t port_;
    std::array<std::uint8_t, 4> numbers_;
};

}  // namespace nplc::hal_mcu::stellaris
