#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sim/motor_memory.h"

namespace nplc::sim {

/// The speed regulator of 001 §4.2.1: filter FF on FNC_OUT, filter VB on V_IST, filter VF on their
/// difference, times KVOUT, within the torque limit. FIR filters and one IIR filter with the motor's
/// registers as coefficients (001 §3.2.89 - 105, 004).
///
/// If the torque limit is met, the step also answers by how much FNC_OUT should have been another for the
/// limit to be kept ("correction"). The filters go on from the corrected velocity, so nothing winds up.
class Regulator {
  public:
    static constexpr std::size_t kOrder = 6;       // MAC800's
    static constexpr std::size_t kSmallOrder = 4;  // the others'
    using Taps = std::array<double, kOrder>;

    /// By age, the newest sample first; what a family has not is 0.
    struct Coefficients {
        Taps ff{};
        Taps vb{};
        Taps vfx{};
        Taps vfy{};
        std::size_t taps = kOrder;  ///< or kSmallOrder: only so many are computed
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
        double ff_out = 0;            ///< in the unit that the coefficients give it
        double vb_out = 0;
    };

    void use(const Coefficients& coefficients) { c_ = coefficients; }

    Output step(const Input& input);
    void reset();
    /// Profile and shaft are at the same place and run at `velocity`, 1/16 counts/sample, in the next step.
    void restart(std::int32_t velocity);

    /// Some FNC_OUT gives each torque.
    bool answers() const { return c_.ff[0] * c_.vfx[0] > 0; }
    /// How far the shaft is behind the profile, corrections taken off, 1/16 counts.
    std::int64_t lag_16() const { return lag_16_; }

  private:
    /// What this sample adds to the histories.
    struct Newest {
        double fnc_out;
        double v_ist;
        double error = 0;
        double torque = 0;
    };
    template <std::size_t kTaps>
    Output filter(const Input& input);
    std::int32_t correct(double excess, double kvout, Newest& newest) const;

    Coefficients c_;
    Taps fnc_out_{};
    Taps v_ist_{};
    Taps error_{};
    Taps torque_{};
    std::int64_t lag_16_ = 0;
};

/// The filters as the registers have them.
Regulator::Coefficients regulator_coefficients(const MotorMemory& memory);

}  // namespace nplc::sim
