#pragma once

#include <cstdint>
#include <span>

#include "sequencer/state.h"

namespace nplc::seqc {

struct LineSettings {
    std::uint32_t baud = 19'200;
    bool safe_communication = true;  ///< each FastMAC command twice
};

/// Load of the motor's line by the orders of one scan, with the gateway's driver for JVL motors
/// (firmware/motor): 10 bits per character, one message after the other.
struct LineUse {
    std::uint32_t messages = 0;    ///< orders, and protocol changes to FlexMAC and back
    std::uint32_t characters = 0;  ///< sent by the gateway
    /// Minimum time in characters until the motor's status has confirmed the last message: after each message
    /// two equal status bytes; before a FlexMAC message a pause of three characters. The motor is then in
    /// FastMAC again, and the next scan may begin.
    std::uint32_t until_done = 0;
    /// The maximum on a line without faults: one more status byte per message that was already in transit,
    /// and one because another bit of the status changed between the two. The driver's polls are not
    /// included.
    std::uint32_t at_most = 0;
};

LineUse line_use(std::span<const sequencer::MotorOrder> orders, bool safe_communication);

double milliseconds(std::uint32_t characters, std::uint32_t baud);

}  // namespace nplc::seqc
