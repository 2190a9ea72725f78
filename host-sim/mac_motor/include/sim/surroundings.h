#pragma once

#include <cstdint>

namespace nplc::sim {

/// What a MAC800 feels of its surroundings beside its terminals (004); changeable at any time.
struct Surroundings {
    std::int32_t celsius = 25;
    std::int32_t logic_millivolts = 24'000;
    bool encoder_broken = false;

    /// DEGC: 0.12207 degrees each.
    std::int32_t degc() const { return static_cast<std::int32_t>(std::int64_t{celsius} * 100'000 / 12'207); }
    /// U_24V: 0.013428 V each.
    std::int32_t u_24v() const {
        return static_cast<std::int32_t>(std::int64_t{logic_millivolts} * 1000 / 13'428);
    }
};

}  // namespace nplc::sim
