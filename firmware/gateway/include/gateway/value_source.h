#pragma once

#include <cstdint>
#include <optional>

#include "sequencer/state.h"

#ifndef NPLC_SET_POINTS
#define NPLC_SET_POINTS 1
#endif

namespace nplc::gateway {

/// Source of table values that may change between two scans.
class ValueSource {
  public:
    /// There is a change that `step` takes.
    virtual bool has_change(std::uint8_t step) const = 0;
    /// The first call puts all changes into force; each call returns the next order to write to the motor
    /// before the next scan. Empty: no more.
    virtual std::optional<sequencer::MotorOrder> take(std::uint8_t step) = 0;

  protected:
    ~ValueSource() = default;
};

}  // namespace nplc::gateway
