#include "sim/homing.h"

#include <algorithm>
#include <cstdlib>

namespace nplc::sim {

void Homing::begin(Method method) {
    *this = {};
    method_ = method;
}

bool Homing::step(const Input& input) {
    return method_ == Method::torque ? step_torque(input) : step_sensor(input);
}

bool Homing::step_torque(const Input& input) {
    velocity_ = input.v_home;
    if (std::abs(input.torque) > std::abs(input.t_home)) ++detections_;
    return detections_ >= kDetections;
}

// The input is active high if T_HOME is positive, otherwise active low (001 §3.2.41).
bool Homing::step_sensor(const Input& input) {
    const bool active = input.sensor == (input.t_home > 0);
    bool found = false;
    if (phase_ == Phase::leaving && !active) phase_ = Phase::approaching;
    if (phase_ == Phase::approaching && active) {
        found = method_ == Method::sensor_on;
        phase_ = Phase::creeping;
    } else if (phase_ == Phase::creeping) {
        found = !active;
    }
    switch (phase_) {
        case Phase::leaving:
            velocity_ = -input.v_home;
            break;
        case Phase::approaching:
            velocity_ = input.v_home;
            break;
        case Phase::creeping:
            velocity_ = creep(input.v_home);
            break;
    }
    return found;
}

std::int32_t Homing::torque_limit(std::int32_t t_home) {
    constexpr std::int64_t kFull = 1023;
    return static_cast<std::int32_t>(std::min(std::abs(std::int64_t{t_home}) * 5 / 4, kFull));
}

std::int32_t Homing::creep(std::int32_t v_home) {
    const std::int32_t away = v_home > 0 ? -1 : 1;
    const std::int32_t velocity = -v_home / 64 + 1;
    return velocity * away > 0 ? velocity : away;
}

}  // namespace nplc::sim
