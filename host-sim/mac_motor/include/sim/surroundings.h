#pragma once

#include <cstdint>

namespace nplc::sim {

/// What a MAC800 feels of its surroundings beside its terminals (004); changeable at any time.
struct Surroundings {
    static constexpr std::int32_t kRoom = 25;
    std::int32_t celsius = kRoom;
    std::int32_t logic_millivolts = 24'000;
    bool encoder_broken = false;

    /// What is to be added to the DEGC that the servo shows, which takes the air to be at room temperature.
    /// 0.12207 degrees each.
    std::int32_t degc() const {
        return static_cast<std::int32_t>(std::int64_t{celsius - kRoom} * 100'000 / 12'207);
    }
    /// U_24V: 0.013428 V each.
    std::int32_t u_24v() const {
        return static_cast<std::int32_t>(std::int64_t{logic_millivolts} * 1000 / 13'428);
    }
};

}  // namespace nplc::sim
