#pragma once

#include <cstdint>

#include "motor/motor.h"
#include "protocol/fastmac.h"

namespace nplc::motor {

/// Whether the motor's IN_POS can be stale for one sample after this order. The motor clears it at once when
/// a P register is activated and with 02h, 04h, 07h, 0Ch..0Fh (001 §5.2.1.4); after all other orders that can
/// move it, only at its next sample. R.
bool makes_in_position_stale(const Order& order);

/// The same command with its register selection in another coding.
std::uint8_t recoded(std::uint8_t command, protocol::fastmac::RegisterCode code);

}  // namespace nplc::motor
