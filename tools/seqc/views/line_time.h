#pragma once

#include <cstdint>
#include <span>

#include "sequencer/state.h"

namespace nplc::seqc {

struct LineSettings {
    std::uint32_t baud = 19'200;
    bool safe_communication = true;  ///< each FastMAC command twice
};

/// What the orders of one scan put on the motor's line, with the gateway's driver for JVL motors
/// (firmware/motor): 10 bits a character, one message after the other.
struct LineUse {
    std::uint32_t messages = 0;    ///< orders, and switches to FlexMAC and back
    std::uint32_t characters = 0;  ///< ours
    /// Until the motor's status has shown the last message as taken, in characters, at the least: after each
    /// message two equal status bytes; before a FlexMAC message three characters of pause. The motor is in
    /// FastMAC again then, and the next scan may begin.
    std::uint32_t until_done = 0;
    /// The same at the most on a good line: for each message one more status byte that was on its way, and
    /// one because some other bit of the status changed between the two. The driver's own polls come on top.
    std::uint32_t at_most = 0;
};

LineUse line_use(std::span<const sequencer::MotorOrder> orders, bool safe_communication);

double milliseconds(std::uint32_t characters, std::uint32_t baud);

}  // namespace nplc::seqc
