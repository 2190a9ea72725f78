#pragma once

#include <cstdint>

#include "motor/motor.h"

namespace nplc::motor {

/// Can the motor's IN_POS still be true for one sample although the order makes it false? The motor clears it
/// at once when a P register is activated and with 02h, 04h, 07h, 0Ch..0Fh (001 §5.2.1.4); after everything
/// else that can move it, only at its next sample. Our own reading.
bool makes_in_position_stale(const Order& order);

/// The same register selection in the older code that the example of 001 §5.2.1.5 was written in: A 000xx, T
/// 001xx, L 010xx, Z 011xx, V 10xxx, P 11xxx. Command mode is the same in both.
std::uint8_t in_old_code(std::uint8_t command);

}  // namespace nplc::motor
