#include "sim/regulator.h"

#include <algorithm>

namespace nplc::sim {
namespace {

// Percent of the acceleration that each part asks for. Stable, with a load of a half to four times what KVOUT
// says.
constexpr std::int64_t kForward = 100, kVelocity = 60, kLag = 25, kIntegral = 2;
constexpr std::int64_t kOfFncOut = kForward + kVelocity + kLag + kIntegral;

constexpr std::int64_t kFullTorque = 1023;
constexpr std::int64_t kLagBound = std::int64_t{1} << 28;
constexpr std::int64_t kDriveBound = std::int64_t{1} << 36;

}  // namespace

Regulator::Output Regulator::step(const Input& input) {
    const std::int64_t wanted = input.fnc_out;
    const std::int64_t error = wanted - 16 * std::int64_t{input.v_ist};
    lag_16_ = std::clamp(lag_16_ + error, -kLagBound, kLagBound);
    integral_ += kIntegral * lag_16_;
    const std::int64_t drive =
        std::clamp(kForward * (wanted - last_fnc_out_) + kVelocity * error + kLag * lag_16_ + integral_,
                   -kDriveBound, kDriveBound);
    last_fnc_out_ = wanted;

    const std::int64_t gain = std::clamp<std::int64_t>(input.kvout_256, 0, 0xFFFF) * kFullTorque;
    const std::int64_t divisor = 100 * 256 * full_acceleration_16_;
    const std::int64_t limit = std::clamp<std::int64_t>(input.torque_limit, 0, kFullTorque);
    const std::int64_t torque = drive * gain / divisor;
    const std::int64_t limited = std::clamp(torque, -limit, limit);

    std::int64_t correction = 0;
    if (torque != limited) {
        correction = (limited * divisor / gain - drive) / kOfFncOut;
        correction = std::clamp<std::int64_t>(correction, -kLagBound, kLagBound);
        last_fnc_out_ += correction;
        lag_16_ += correction;
        integral_ += kIntegral * correction;
    }
    const std::int64_t integral_bound = 100 * full_acceleration_16_ * 4;
    integral_ = std::clamp(integral_, -integral_bound, integral_bound);
    return {static_cast<std::int32_t>(limited), static_cast<std::int32_t>(correction)};
}

void Regulator::restart(std::int32_t velocity) {
    reset();
    lag_16_ = velocity;  // which the next step takes off again
    last_fnc_out_ = velocity;
}

void Regulator::reset() {
    lag_16_ = 0;
    integral_ = 0;
    last_fnc_out_ = 0;
}

}  // namespace nplc::sim
