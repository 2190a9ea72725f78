#pragma once

#include <cstdint>

#include "protocol/mactalk.h"

namespace nplc::boards {

struct Addresses {
    std::uint8_t gateway;
    std::uint8_t motor;
};

/// What a client's message to the gateway or to the motor behind it is for.
enum class Purpose : std::uint8_t {
    reads,
    stops,     ///< writes the command stop, safe or hold, or MODE_REG := 0 of the motor
    operates,  ///< everything else: it may start or move something
};
/// Of one that operates: whether it needs the operator's seat, which all do that change more than what a
/// later command goes by.
bool needs_seat(const protocol::mactalk::Request& request, const Addresses& addresses);
Purpose purpose_of(const protocol::mactalk::Request& request, const Addresses& addresses);

}  // namespace nplc::boards
