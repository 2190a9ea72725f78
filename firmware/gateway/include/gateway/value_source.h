#pragma once

#include <cstdint>
#include <optional>

#include "sequencer/state.h"

#ifndef NPLC_SET_POINTS
#define NPLC_SET_POINTS 1
#endif

namespace nplc::gateway {

/// Values of the table that may change between two scans.
class ValueSource {
  public:
    /// Something has changed that `step` takes.
    virtual bool has_change(std::uint8_t step) const = 0;
    /// All of it takes hold with the first call; then what is to be written to the motor before the next
    /// scan, one after the other. Nothing: that was all.
    virtual std::optional<sequencer::MotorOrder> take(std::uint8_t step) = 0;

  protected:
    ~ValueSource() = default;
};

}  // namespace nplc::gateway
