#include "sim/regulator.h"

#include <algorithm>

namespace nplc::sim {
namespace {

constexpr double kLeastGain = 1e-6;       // below it no FNC_OUT could have corrected it
constexpr double kCorrectionBound = 1e8;  // 1/16 counts/sample

}  // namespace

void Regulator::use(const Coefficients& coefficients) {
    c_ = coefficients;
    for (std::size_t i = 0; i < kOrder; ++i) {
        ff_vb_[i] = Pair{c_.ff[i], c_.vb[i]};
        vfx_vfy_[i] = Pair{c_.vfx[i], c_.vfy[i]};
    }
}

/// Removes `excess` torque from the filters, as if FNC_OUT had been different.
std::int32_t Regulator::correct(double excess, double kvout, Newest& newest) const {
    const double gain = c_.ff[0] * c_.vfx[0] * kvout;
    if (gain < kLeastGain) {  // R: no velocity can correct these coefficients: only the output is limited
        newest.torque += excess / std::max(kvout, kLeastGain);
        return 0;
    }
    const auto correction = static_cast<std::int32_t>(within(excess / gain, kCorrectionBound));
    newest.fnc_out += correction;
    newest.error += c_.ff[0] * correction;
    newest.torque += c_.vfx[0] * c_.ff[0] * correction;
    return correction;
}

// Sets the sum of VF's input to its steady value: the lag minus what the filters hold. With two poles at 1
// its output rises, per unit of that, by the sum of its numerator over the rest of its denominator at 1.
void Regulator::restart(std::int32_t velocity) {
    reset();
    lag_16_ = velocity;
    velocities_.fill(Pair{static_cast<double>(velocity), velocity / 16.0});
    double sum = 0;
    double gone = 0;  // of the lag, what the filters do not hold
    double rest = 0;
    for (std::size_t i = 0; i < kOrder; ++i) {
        const auto age = static_cast<double>(i);
        sum += c_.vfx[i];
        gone += c_.ff[i] - age * (c_.ff[i] - c_.vb[i] / 16);
        rest -= age * (age + 1) / 2 * c_.vfy[i];
    }
    const double rise = rest < kLeastGain ? 0 : sum * velocity * gone / rest;
    for (std::size_t i = 1; i < kOrder; ++i) {
        answers_[i][1] = std::clamp(-rise * static_cast<double>(i), -kTorqueBound, kTorqueBound);
    }
}

void Regulator::reset() {
    lag_16_ = 0;
    velocities_ = answers_ = {};
    answered_ = 0;
}

Regulator::Coefficients regulator_coefficients(const MotorMemory& memory) {
    Regulator::Coefficients c;
    const auto fill = [&](Regulator::Taps& taps, Cell first, int count, double one) {
        for (int i = 0; i < count; ++i) taps[static_cast<std::size_t>(i)] = memory.get(first[i]) / one;
    };
    if (is_mac800(memory.model())) {
        constexpr double kFixed16 = 65536, kFixed24 = 16777216;
        fill(c.ff, cell::KFF, 6, kFixed24);
        fill(c.vb, cell::KVB, 5, kFixed24);
        fill(c.vfx, cell::KVFX, 6, kFixed16);
        fill(c.vfy, cell::KVFY, 6, kFixed16);
        return c;
    }
    constexpr double kFixed4 = 4096, kFixed8 = 256;
    c.taps = Regulator::kSmallOrder;
    fill(c.ff, cell::KFF, 4, kFixed8);
    fill(c.vb, cell::KVB, 4, kFixed8);
    fill(c.vfx, cell::KVFX, 4, kFixed4);
    fill(c.vfy, cell::KVFY, 4, kFixed4);
    for (double& coefficient : c.vb) coefficient *= memory.get(cell::GEARB) / kFixed8;
    return c;
}

}  // namespace nplc::sim
