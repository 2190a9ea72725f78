#pragma once

#include <cstdint>

#include "protocol/mactalk.h"

namespace nplc::boards {

struct Addresses {
    std::uint8_t gateway;
    std::uint8_t motor;
};

/// Purpose of a client's message to the gateway or to its motor.
enum class Purpose : std::uint8_t {
    reads,
    stops,     ///< writes the command stop, safe or hold, or MODE_REG := 0 of the motor
    operates,  ///< everything else: it may start or move something
};
/// For an operating message: whether it needs the operator's seat, which every message does that changes more
/// than a parameter of a later command.
bool needs_seat(const protocol::mactalk::Request& request, const Addresses& addresses);
Purpose purpose_of(const protocol::mactalk::Request& request, const Addresses& addresses);

}  // namespace nplc::boards
