#pragma once

#include <cstddef>

#include "sim/bounds.h"
#include "sim/current_regulator.h"
#include "sim/sine_table.h"

namespace nplc::sim {

/// Three windings in a star whose middle is open, on a rotor with a sinusoidal field. Currents and voltages
/// in the registers' units, the voltages at the nominal supply; a step is a sample of the inner loop.
class Winding {
  public:
    struct Constants {
        double resistance;  ///< voltage a current
        double decay;       ///< what is left of a current after a step without voltage: exp(-T R / L)
        double emf;         ///< voltage a count/step
        double torque;      ///< 1023 over the current that full torque takes
    };
    struct Step {
        double torque;  ///< as in T_SOLL
        double power;   ///< into the windings, voltage x current
    };

    explicit Winding(const Constants& constants)
        : c_(constants), conductance_((1 - constants.decay) / constants.resistance) {}

    /// `voltage` at the terminals, times `supply` (1: nominal); rotor at `angle`, 0 to 2047, at `velocity`
    /// counts/step. The torque is that of the currents' mean.
    Step step(const PerPhase<std::int32_t>& voltage, double supply, std::int32_t angle, double velocity) {
        const double middle = (voltage[0] + voltage[1] + voltage[2]) * (1 / 3.0);
        const PerPhase<double> shapes = kSine.phases(angle);
        const double field = c_.emf * velocity;
        Step done{0, 0};
        for (std::size_t p = 0; p < kPhases; ++p) {
            const double across = (voltage[p] - middle) * supply;
            const double shape = shapes[p];
            const double before = current_[p];
            current_[p] = within(before * c_.decay + (across - field * shape) * conductance_, kMost);
            const double mean = (before + current_[p]) / 2;
            done.torque += mean * shape;
            done.power += mean * across;
        }
        done.torque *= c_.torque * (2.0 / 3.0);
        return done;
    }

    const PerPhase<double>& currents() const { return current_; }
    void rest() { current_ = {}; }

  private:
    static constexpr double kMost = 1e6;

    Constants c_;
    double conductance_;
    PerPhase<double> current_{};
};

}  // namespace nplc::sim
