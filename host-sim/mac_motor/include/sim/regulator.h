#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "sim/bounds.h"
#include "sim/motor_memory.h"

namespace nplc::sim {

/// The speed regulator of 001 §4.2.1: filter FF on FNC_OUT, filter VB on V_IST, filter VF on their
/// difference, times KVOUT, within the torque limit. FIR filters and one IIR filter with the motor's
/// registers as coefficients (001 §3.2.89 - 105, 004).
///
/// In torque limit, the step also returns the change of FNC_OUT that would keep the limit ("correction"). The
/// filters continue from the corrected velocity, which prevents windup.
class Regulator {
  public:
    static constexpr std::size_t kOrder = 6;       // MAC800's
    static constexpr std::size_t kSmallOrder = 4;  // the others'
    using Taps = std::array<double, kOrder>;

    /// By age, the newest sample first; coefficients that a family does not have are 0.
    struct Coefficients {
        Taps ff{};
        Taps vb{};
        Taps vfx{};
        Taps vfy{};
        std::size_t taps = kOrder;  ///< or kSmallOrder: number of taps computed
    };
    struct Input {
        std::int32_t fnc_out;       ///< wanted velocity, 1/16 counts/sample
        std::int32_t v_ist;         ///< measured velocity, counts/sample
        std::int32_t torque_limit;  ///< 0..1023
        double kvout;
    };
    struct Output {
        std::int32_t torque = 0;      ///< VF_OUT, within the limit
        std::int32_t correction = 0;  ///< to be added to FNC_OUT, 1/16 counts/sample; 0 within the limit
        double ff_out = 0;            ///< in the unit given by the coefficients
        double vb_out = 0;
    };

    void use(const Coefficients& coefficients);

    Output step(const Input& input) {
        return c_.taps == kSmallOrder ? filter<kSmallOrder>(input) : filter<kOrder>(input);
    }
    void reset();
    /// Profile and shaft have the same position and run at `velocity`, 1/16 counts/sample, in the next step.
    void restart(std::int32_t velocity);

    /// Every torque can be reached by some FNC_OUT.
    bool answers() const { return c_.ff[0] * c_.vfx[0] > 0; }
    /// Lag of the shaft behind the profile, without corrections, 1/16 counts.
    std::int64_t lag_16() const { return lag_16_; }

  private:
    /// Two filters are computed together: FF with VB, and the input part of VF with its output part.
    using Pair [[gnu::vector_size(16)]] = double;
    using Pairs = std::array<Pair, kOrder>;
    /// The values that this sample adds to the histories.
    struct Newest {
        double fnc_out;
        double v_ist;
        double error = 0;
        double torque = 0;
    };
    static constexpr std::int64_t kLagBound = std::int64_t{1} << 28;
    static constexpr double kTorqueBound = 1e9;  // keeps extreme coefficients finite

    template <std::size_t kTaps>
    Output filter(const Input& input);
    /// The sums of the samples times `c`: `newest` in place of the first of `history`.
    template <std::size_t kTaps>
    static Pair filtered(const Pairs& c, Pair newest, const Pairs& history) {
        Pair even = c[0] * newest;
        Pair odd = c[1] * history[1];
        for (std::size_t i = 2; i < kTaps; i += 2) {
            even += c[i] * history[i];
            odd += c[i + 1] * history[i + 1];
        }
        return even + odd;
    }
    template <std::size_t kTaps>
    static void remember(Pairs& history, Pair newest) {
#pragma GCC unroll 5
        for (std::size_t i = kTaps - 1; i > 1; --i) history[i] = history[i - 1];
        history[1] = newest;
    }
    std::int32_t correct(double excess, double kvout, Newest& newest) const;

    Coefficients c_;
    Pairs ff_vb_{};    // c_'s
    Pairs vfx_vfy_{};  // c_'s
    // By age, from 1 on.
    Pairs velocities_{};   // FNC_OUT and V_IST
    Pairs answers_{};      // VF's input, with VF's output of the previous sample
    double answered_ = 0;  // VF's last output
    std::int64_t lag_16_ = 0;
};

template <std::size_t kTaps>
Regulator::Output Regulator::filter(const Input& input) {
    Newest newest{.fnc_out = static_cast<double>(input.fnc_out), .v_ist = static_cast<double>(input.v_ist)};
    const Pair velocity = filtered<kTaps>(ff_vb_, Pair{newest.fnc_out, newest.v_ist}, velocities_);
    Output out{.ff_out = velocity[0], .vb_out = velocity[1]};
    newest.error = out.ff_out - out.vb_out;
    const Pair answer = filtered<kTaps>(vfx_vfy_, Pair{newest.error, answered_}, answers_);
    newest.torque = within(answer[0] + answer[1], kTorqueBound);

    const double torque = newest.torque * input.kvout;
    const double limited = within(torque, input.torque_limit);
    out.torque = nearest(limited);
    if (torque != limited) {
        out.correction = correct(limited - torque, input.kvout, newest);
        out.ff_out += c_.ff[0] * out.correction;
    }
    remember<kTaps>(velocities_, Pair{newest.fnc_out, newest.v_ist});
    remember<kTaps>(answers_, Pair{newest.error, answered_});
    answered_ = newest.torque;
    lag_16_ = std::clamp(lag_16_ + input.fnc_out + out.correction - 16 * std::int64_t{input.v_ist},
                         -kLagBound, kLagBound);
    return out;
}

/// The filter coefficients from the registers.
Regulator::Coefficients regulator_coefficients(const MotorMemory& memory);

}  // namespace nplc::sim
