#pragma once

#include <cstdint>

#include "sequencer/state.h"

namespace nplc::gateway {

/// The mode that a sequence's orders have led the motor to (001 §5.2.1.4), as far as that can be told: so
/// that a motor that was stopped can be given its mode back.
class MotorMode {
  public:
    bool is_known() const { return mode_ != kUnknown; }
    void forget() { mode_ = kUnknown; }
    /// Mode 0: it has stopped by itself, or was told to.
    void set_passive() { mode_ = kPassive; }
    void follow(const sequencer::MotorOrder& order);

    bool is_passive() const { return mode_ == kPassive; }
    bool is_velocity() const { return mode_ == 1; }
    /// MODE_REG := the mode. P_SOLL and V_SOLL are as they were, so nothing is moved twice.
    sequencer::MotorOrder order(bool longword) const;

  private:
    static constexpr std::uint8_t kPassive = 0;
    static constexpr std::uint8_t kUnknown = 0xFF;

    std::uint8_t mode_ = kUnknown;  ///< 0, 1 (velocity), 2 (position) or kUnknown
};

}  // namespace nplc::gateway
