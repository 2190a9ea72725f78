#include "sim/regulator.h"

#include <algorithm>
#include <cstdlib>

#include "sim/bounds.h"

namespace nplc::sim {
namespace {

constexpr std::int64_t kLagBound = std::int64_t{1} << 28;
constexpr double kTorqueBound = 1e9;      // keeps wild coefficients finite
constexpr double kLeastGain = 1e-6;       // below it no FNC_OUT would have helped
constexpr double kCorrectionBound = 1e8;  // 1/16 counts/sample

template <std::size_t kTaps>
void remember(Regulator::Taps& history, double value) {
    for (std::size_t i = kTaps - 1; i > 0; --i) history[i] = history[i - 1];
    history[0] = value;
}

/// `before`: without `newest`, which is not remembered yet.
template <std::size_t kTaps>
double filtered(const Regulator::Taps& c, double newest, const Regulator::Taps& before) {
    double even = c[0] * newest;
    double odd = c[1] * before[0];
    for (std::size_t i = 2; i < kTaps; i += 2) {
        even += c[i] * before[i - 1];
        odd += c[i + 1] * before[i];
    }
    return even + odd;
}

/// Of its own outputs so far.
template <std::size_t kTaps>
double fed_back(const Regulator::Taps& c, const Regulator::Taps& before) {
    double even = c[0] * before[0];
    double odd = c[1] * before[1];
    for (std::size_t i = 2; i < kTaps; i += 2) {
        even += c[i] * before[i];
        odd += c[i + 1] * before[i + 1];
    }
    return even + odd;
}

}  // namespace

Regulator::Output Regulator::step(const Input& input) {
    return c_.taps == kSmallOrder ? filter<kSmallOrder>(input) : filter<kOrder>(input);
}

template <std::size_t kTaps>
Regulator::Output Regulator::filter(const Input& input) {
    Newest newest{.fnc_out = static_cast<double>(input.fnc_out), .v_ist = static_cast<double>(input.v_ist)};
    Output out;
    out.ff_out = filtered<kTaps>(c_.ff, newest.fnc_out, fnc_out_);
    out.vb_out = filtered<kTaps>(c_.vb, newest.v_ist, v_ist_);
    newest.error = out.ff_out - out.vb_out;
    newest.torque = within(filtered<kTaps>(c_.vfx, newest.error, error_) + fed_back<kTaps>(c_.vfy, torque_),
                           kTorqueBound);

    const double torque = newest.torque * input.kvout;
    const double limited = within(torque, input.torque_limit);
    out.torque = nearest(limited);
    if (torque != limited) {
        out.correction = correct(limited - torque, input.kvout, newest);
        out.ff_out += c_.ff[0] * out.correction;
    }
    remember<kTaps>(fnc_out_, newest.fnc_out);
    remember<kTaps>(v_ist_, newest.v_ist);
    remember<kTaps>(error_, newest.error);
    remember<kTaps>(torque_, newest.torque);
    lag_16_ = std::clamp(lag_16_ + input.fnc_out + out.correction - 16 * std::int64_t{input.v_ist},
                         -kLagBound, kLagBound);
    return out;
}

/// Takes `excess` of torque back out of the filters, as if FNC_OUT had been another.
std::int32_t Regulator::correct(double excess, double kvout, Newest& newest) const {
    const double gain = c_.ff[0] * c_.vfx[0] * kvout;
    if (gain < kLeastGain) {  // R: coefficients that no velocity can answer for: the output alone is held
        newest.torque += excess / std::max(kvout, kLeastGain);
        return 0;
    }
    const auto correction = static_cast<std::int32_t>(within(excess / gain, kCorrectionBound));
    newest.fnc_out += correction;
    newest.error += c_.ff[0] * correction;
    newest.torque += c_.vfx[0] * c_.ff[0] * correction;
    return correction;
}

// VF is given the sum of its input as it would be: the lag less what the filters still hold. With two poles
// at 1 its output rises by the sum of its numerator over what else its denominator is at 1, for each unit of
// that.
void Regulator::restart(std::int32_t velocity) {
    reset();
    lag_16_ = velocity;
    fnc_out_.fill(velocity);
    v_ist_.fill(velocity / 16.0);
    double sum = 0;
    double gone = 0;  // of the lag, what the filters do not hold
    double rest = 0;
    for (std::size_t i = 0; i < torque_.size(); ++i) {
        const auto age = static_cast<double>(i);
        sum += c_.vfx[i];
        gone += c_.ff[i] - age * (c_.ff[i] - c_.vb[i] / 16);
        rest -= age * (age + 1) / 2 * c_.vfy[i];
    }
    const double rise = rest < kLeastGain ? 0 : sum * velocity * gone / rest;
    for (std::size_t i = 0; i < torque_.size(); ++i) {
        torque_[i] = std::clamp(-rise * static_cast<double>(i), -kTorqueBound, kTorqueBound);
    }
}

void Regulator::reset() {
    lag_16_ = 0;
    fnc_out_ = v_ist_ = error_ = torque_ = {};
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
