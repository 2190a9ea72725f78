#pragma once

#include <cstdint>

#include "motor/motor.h"
#include "protocol/fastmac.h"

namespace nplc::motor {

/// Can the motor's IN_POS still be true for one sample although the order makes it false? The motor clears it
/// at once when a P register is activated and with 02h, 04h, 07h, 0Ch..0Fh (001 §5.2.1.4); after everything
/// else that can move it, only at its next sample. Our own reading.
bool makes_in_position_stale(const Order& order);

/// The same command with its register selection in another code.
std::uint8_t recoded(std::uint8_t command, protocol::fastmac::RegisterCode code);

}  // namespace nplc::motor
