#pragma once

#include <cstdint>

#include "sim/phases.h"
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

        : decay_(constants.decay),
          conductance_((1 - constants.decay) / constants.resistance),
          emf_(constants.emf),
          torque_(constants.torque / 3.0) {}

    /// `voltage` at the terminals, times `supply` (1: nominal); rotor at `angle`, 0 to 2047, at `velocity`
    /// counts/step. The torque is that of the currents' mean.
    Step step(Phases voltage, double supply, std::int32_t angle, double velocity) {
        const double middle = voltage.sum() * (1 / 3.0);
        const Phases shapes = kSine.phases(angle);
        const Phases across = (voltage - middle) * supply;
        const Phases before = current_;
        const Phases kept = before * decay_ - shapes * (emf_ * velocity * conductance_);
        current_ = kept + (voltage - middle) * (supply * conductance_);
        const Phases twice = before + current_;
        return {.torque = (twice * shapes).sum() * torque_, .power = (twice * across).sum() * 0.5};
    }

    Phases currents() const { return current_; }
    void rest() { current_ = {}; }

  private:
    Phases decay_;
    double conductance_;
    double emf_;
    double torque_;  // of the sum of the currents before and after a step
    Phases current_;
};

}  // namespace nplc::sim
