#pragma once

#include <cstdint>

#include "protocol/mactalk.h"
#include "registers/gateway.h"

namespace nplc::boards {

/// The word in register RESULT.
constexpr std::uint32_t result_word(registers::gateway::Result result, std::uint8_t reg,
                                    std::uint16_t detail = 0) {
    return static_cast<std::uint32_t>(result) | std::uint32_t{reg} << 8 | std::uint32_t{detail} << 16;
}

/// The gateway completes such a request even after a stop, and reports its outcome (REGISTERS.md,
/// Set-points).
constexpr bool is_for_set_points(const protocol::mactalk::Request& message, std::uint8_t gateway) {
    return message.address == gateway && message.reg == registers::gateway::SET_POINT_WRITE;
}

}  // namespace nplc::boards
