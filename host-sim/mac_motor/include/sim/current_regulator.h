#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "sim/bounds.h"
#include "sim/motor_memory.h"
#include "sim/sine_table.h"

namespace nplc::sim {

/// The motor's inner loop (001 §4.3): commutation, and per phase filter IB on the measured current, filter IF
/// on the error, with the motor's registers as coefficients. In the registers' units: currents 1023 at the
/// end of the measuring range, voltages 1023 at the whole supply, angles 2048 a turn of the field.
class CurrentRegulator {
  public:
    struct Settings {
        double kifx2 = 0, kifx1 = 0, kify1 = 0, kify0 = 0, kib1 = 0, kib0 = 0;
        double amplitude = 0;
        double phase_comp = 0;
        PerPhase<double> gain{1, 1, 1};  ///< KIA, KIB, KIC
        PerPhase<std::int32_t> offset{};
        bool third_is_rest = false;  ///< MAC800 measures two currents
    };
    static constexpr std::int32_t kRange = 1023;
    static constexpr std::int32_t kTurn = SineTable::kTurn;

    void use(const Settings& settings) { s_ = settings; }
    void reset();

    /// Currents as the converters give them, without offset.
    void measure(const PerPhase<std::int32_t>& converted) {
        for (std::size_t p = 0; p < kPhases; ++p) {
            measured_[p] = limited((converted[p] + s_.offset[p]) * s_.gain[p], kRange);
        }
        if (s_.third_is_rest) measured_[2] = std::clamp(-measured_[0] - measured_[1], -kRange, kRange);
        for (const std::int32_t current : measured_) at_the_end_ |= current == kRange || current == -kRange;
    }
    /// A field of `torque` (with its sign) across the rotor at `eldeg`, which goes on by `v_eldeg` a sample.
    void commutate(std::int32_t torque, std::int32_t eldeg, std::int32_t v_eldeg) {
        const std::int32_t lead = limited(v_eldeg * s_.phase_comp, kLargest);  // 001 §3.2.126
        const std::int32_t half_turn = torque < 0 ? kTurn / 2 : 0;
        aim(torque < 0 ? -torque : torque, eldeg + lead + half_turn);
    }
    /// A field of `i_nom` at `angle`.
    void aim(std::int32_t i_nom, std::int32_t angle) {
        i_nom_ = i_nom;
        phi_ = angle & (kTurn - 1);
        const double amplitude = i_nom * s_.amplitude;
        const PerPhase<double> sines = kSine.phases(phi_);
        for (std::size_t p = 0; p < kPhases; ++p) wanted_[p] = limited(amplitude * sines[p], kLargest);
    }
    /// Regulates what was measured to what was asked for; the answer is in `voltage`.
    void regulate() {
        for (std::size_t p = 0; p < kPhases; ++p) {
            const double measured = measured_[p];
            const double error = wanted_[p] - (s_.kib1 * measured + s_.kib0 * measured_before_[p]);
            const double output = s_.kifx2 * error + s_.kifx1 * error_before_[p] + s_.kify1 * output_[p] +
                                  s_.kify0 * output_before_[p];
            measured_before_[p] = measured;
            error_before_[p] = error;
            output_before_[p] = output_[p];
            output_[p] = std::clamp<double>(output, -kRange, kRange);  // so that it cannot wind up
            voltage_[p] = nearest(output_[p]);
        }
    }
    /// No regulation: these voltages, and filters that have forgotten.
    void apply(const PerPhase<std::int32_t>& voltage);

    const PerPhase<std::int32_t>& wanted() const { return wanted_; }      ///< IA_SOLL ...
    const PerPhase<std::int32_t>& measured() const { return measured_; }  ///< IA_IST ...
    const PerPhase<std::int32_t>& voltage() const { return voltage_; }    ///< UA_VAL ...
    std::int32_t i_nom() const { return i_nom_; }
    std::int32_t phi_soll() const { return phi_; }
    /// A current was at the end of its measuring range since this was cleared.
    bool at_the_end() const { return at_the_end_; }
    void clear_at_the_end() { at_the_end_ = false; }

  private:
    static constexpr double kLargest = 32767;

    static std::int32_t limited(double value, double limit) { return nearest(within(value, limit)); }

    Settings s_;
    PerPhase<std::int32_t> wanted_{};
    PerPhase<std::int32_t> measured_{};
    PerPhase<std::int32_t> voltage_{};
    PerPhase<double> measured_before_{};
    PerPhase<double> error_before_{};
    PerPhase<double> output_{};
    PerPhase<double> output_before_{};
    std::int32_t i_nom_ = 0;
    std::int32_t phi_ = 0;
    bool at_the_end_ = false;
};

/// The loop as the registers have it.
CurrentRegulator::Settings current_settings(const MotorMemory& memory);

}  // namespace nplc::sim
