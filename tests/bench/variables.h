#pragma once

#include <array>
#include <cstdint>

#include "sequencer/state.h"

namespace nplc::bench {

using sequencer::MotorOrder;
using sequencer::State;

/// HW_INP as an IEC program sees it: a BOOL, that is a byte, an input.
using Bools = std::array<std::uint8_t, 8>;

/// The variables of the ST program.
struct Variables {
    std::int16_t step = 0;
    std::uint16_t timer = 0;
    std::uint16_t counter = 0;
    std::array<std::uint8_t, 4> out{};
};

/// All images spread out, so that a scan gets its BOOLs by copying eight bytes.
inline constexpr auto kSpread = [] {
    std::array<Bools, 256> all{};
    for (unsigned image = 0; image < 256; ++image) {
        for (unsigned i = 0; i < 8; ++i) all[image][i] = static_cast<std::uint8_t>(image >> i & 1);
    }
    return all;
}();

}  // namespace nplc::bench
