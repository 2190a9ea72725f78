#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "registers/mac.h"
#include "sequencer/term.h"

namespace nplc::sim {

inline constexpr std::uint8_t kVelocityV1 = 0x28;  // 001 §5.2.1.4: velocity mode, V1

/// The table's bytes, with its end.
inline std::vector<std::uint8_t> table_of(std::span<const sequencer::Term> terms) {
    std::vector<std::uint8_t> bytes;
    for (const sequencer::Term& one : terms) {
        const auto encoded = encode(one);
        bytes.insert(bytes.end(), encoded.begin(), encoded.end());
    }
    bytes.insert(bytes.end(), {0x3F, 0, 0, 0, 0, 0, 0, 0});
    return bytes;
}

inline sequencer::Term with_command(sequencer::Term base, std::uint8_t command) {
    base.fast.sends = true;
    base.fast.command = command;
    return base;
}

/// Turns for ever: writes V1 and A1, INIT(A1), then velocity mode; OUT0.
inline std::vector<std::uint8_t> turning_table() {
    using sequencer::Term;
    const auto term = [](std::uint8_t step, std::uint8_t next) {
        Term result;
        result.condition = {.step = step};
        result.fast.next_step = next;
        result.fast.outputs = 1;
        return result;
    };
    const auto write = [&](std::uint8_t reg, std::uint16_t value) {
        Term result = term(0, 0);
        result.is_flex = true;
        result.flex = {.reg = reg, .longword = false, .low_word = value, .high_word = 0};
        return result;
    };
    const Term terms[]{write(registers::V1, 1000), write(registers::A1, 80), with_command(term(0, 1), 0x10),
                       with_command(term(1, 2), kVelocityV1)};
    return table_of(terms);
}

}  // namespace nplc::sim
