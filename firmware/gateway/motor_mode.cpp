#include "gateway/motor_mode.h"

#include "protocol/fastmac.h"
#include "registers/mac.h"

namespace nplc::gateway {

using protocol::fastmac::command_byte;
using protocol::fastmac::Number;

/// An error that no scan saw may have ended a motion before "reset error", and a home search ends in a mode
/// that the motor chooses: the mode is unknown then.
void MotorMode::follow(const sequencer::MotorOrder& order) {
    constexpr std::uint8_t kPosition = 2;
    constexpr std::uint8_t kCommandMode = 3;
    if (order.is_register_write) {
        const auto word = static_cast<std::uint16_t>(order.value);
        if (order.reg == registers::MODE_REG)
            mode_ = word <= kPosition ? static_cast<std::uint8_t>(word) : kUnknown;
        return;
    }
    const auto mode = static_cast<std::uint8_t>(order.command >> 5 & 3);
    if (mode != kCommandMode)
        mode_ = mode;
    else if (order.command == command_byte(Number::home) ||
             (order.command == command_byte(Number::reset_error) && !is_passive()))
        mode_ = kUnknown;
}

sequencer::MotorOrder MotorMode::order(bool longword) const {
    return {.is_register_write = true, .reg = registers::MODE_REG, .longword = longword, .value = mode_};
}

}  // namespace nplc::gateway
