#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sim/bounds.h"
#include "sim/motor_memory.h"
#include "sim/phases.h"
#include "sim/sine_table.h"

namespace nplc::sim {

/// The motor's inner loop (001 §4.3): commutation, and per phase filter IB on the measured current, filter IF
/// on the error, with the motor's registers as coefficients. In the registers' units: currents 1023 at the
/// end of the measuring range, voltages 1023 at the whole supply, angles 2048 a turn of the field.
class CurrentRegulator {
  public:
    struct Settings {
        Phases kifx2, kifx1, kify1, kify0, kib1, kib0;  ///< each the same three times
        double amplitude = 0;
        std::int64_t phase_comp_256 = 0;
        Phases gain{1, 1, 1};  ///< KIA, KIB, KIC
        Phases offset;
        bool third_is_rest = false;  ///< MAC800 measures two currents
    };
    static constexpr std::int32_t kRange = 1023;
    static constexpr std::int32_t kTurn = SineTable::kTurn;

    void use(const Settings& settings) { s_ = settings; }
    void reset();

    /// Currents as the converters give them, whole, without offset.
    void measure(Phases converted) {
        const Phases scaled = (converted + s_.offset) * s_.gain;
        const bool inside = scaled.inside(kRange - 1);
        measured_ = (inside ? scaled : scaled.clamped(-kRange, kRange)).nearest();
        if (s_.third_is_rest) {
            const double rest = within(-measured_.a() - measured_.b(), kRange);
            measured_ = {measured_.a(), measured_.b(), rest};
        } else if (inside) {
            return;
        }
        at_the_end_ |= !measured_.inside(kRange - 1);
    }
    /// A field of `torque` (with its sign) across the rotor at `eldeg`, which goes on by `v_eldeg` a sample.
    void commutate(std::int32_t torque, std::int32_t eldeg, std::int32_t v_eldeg) {
        const std::int64_t ahead = (v_eldeg * s_.phase_comp_256 + 128) >> 8;  // 001 §3.2.126
        const auto lead = static_cast<std::int32_t>(std::clamp(ahead, -kLargest, kLargest));
        const std::int32_t half_turn = torque < 0 ? kTurn / 2 : 0;
        aim(torque < 0 ? -torque : torque, eldeg + lead + half_turn);
    }
    /// A field of `i_nom` at `angle`.
    void aim(std::int32_t i_nom, std::int32_t angle) {
        i_nom_ = i_nom;
        phi_ = angle & (kTurn - 1);
        const double amplitude = i_nom * s_.amplitude;
        wanted_ = kSine.phases(phi_, amplitude);
        if (std::abs(amplitude) > kLargest) wanted_ = wanted_.within(kLargest);
        wanted_ = wanted_.nearest();
    }
    /// Regulates what was measured to what was asked for; the answer is in `voltage`.
    void regulate() {
        const Phases error = wanted_ - (measured_ * s_.kib1 + measured_before_ * s_.kib0);
        const Phases kept = error_before_ * s_.kifx1 + output_ * s_.kify1 + output_before_ * s_.kify0;
        const Phases output = (error * s_.kifx2 + kept).within(kRange);  // so that it cannot wind up
        measured_before_ = measured_;
        error_before_ = error;
        output_before_ = output_;
        output_ = output;
        voltage_ = output.nearest();
    }
    /// No regulation: these voltages, and filters that have forgotten.
    void apply(const PerPhase<std::int32_t>& voltage);

    Phases wanted() const { return wanted_; }      ///< IA_SOLL ..., whole
    Phases measured() const { return measured_; }  ///< IA_IST ...
    Phases voltage() const { return voltage_; }    ///< UA_VAL ...
    std::int32_t i_nom() const { return i_nom_; }
    std::int32_t phi_soll() const { return phi_; }
    /// A current was at the end of its measuring range since this was cleared.
    bool at_the_end() const { return at_the_end_; }
    void clear_at_the_end() { at_the_end_ = false; }

  private:
    static constexpr std::int64_t kLargest = 32767;

    Settings s_;
    Phases wanted_;
    Phases measured_;
    Phases voltage_;
    Phases measured_before_;
    Phases error_before_;
    Phases output_;
    Phases output_before_;
    std::int32_t i_nom_ = 0;
    std::int32_t phi_ = 0;
    bool at_the_end_ = false;
};

/// The loop as the registers have it.
CurrentRegulator::Settings current_settings(const MotorMemory& memory);

}  // namespace nplc::sim
