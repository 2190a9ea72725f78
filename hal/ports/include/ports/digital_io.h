#pragma once

#include <cstdint>

namespace nplc::ports {

/// Six logic inputs, bit 0 = input 0, 1 = active. Not debounced: the gateway does that.
class DigitalInputs {
  public:
    virtual std::uint8_t read() = 0;

  protected:
    ~DigitalInputs() = default;
};

/// Four logic outputs, bit 0 = output 0, 1 = active.
class DigitalOutputs {
  public:
    virtual void write(std::uint8_t levels) = 0;

  protected:
    ~DigitalOutputs() = default;
};

}  // namespace nplc::ports
