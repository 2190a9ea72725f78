#pragma once

#include <cstdint>

#include "sequencer/state.h"

namespace nplc::gateway {

/// Tracks the motor's mode (001 §5.2.1.4) from the sequence's orders, as far as it can be derived, so that it
/// can be restored after a hold.
class MotorMode {
  public:
    bool is_known() const { return mode_ != kUnknown; }
    void forget() { mode_ = kUnknown; }
    /// Mode 0: the motor has stopped by itself or was told to.
    void set_passive() { mode_ = kPassive; }
    void follow(const sequencer::MotorOrder& order);

    bool is_passive() const { return mode_ == kPassive; }
    bool is_velocity() const { return mode_ == 1; }
    /// MODE_REG := the mode. P_SOLL and V_SOLL are unchanged, so no move is repeated.
    sequencer::MotorOrder order(bool longword) const;

  private:
    static constexpr std::uint8_t kPassive = 0;
    static constexpr std::uint8_t kUnknown = 0xFF;

    std::uint8_t mode_ = kUnknown;  ///< 0, 1 (velocity), 2 (position) or kUnknown
};

}  // namespace nplc::gateway
