#pragma once

#include <cmath>
#include <cstdint>

#include "sim/motor_constants.h"
#include "sim/plant.h"

namespace nplc::sim {

/// What windings and current loop do in an outer sample, in one step: the torque comes as the loop with the
/// coefficients from the box gives it, within what the supply can drive against the EMF. Currents and
/// voltages in the registers' units.
class QuickLoop {
  public:
    struct Step {
        double squares;  ///< of the three currents, summed
        double watts;    ///< into the windings
    };

    explicit QuickLoop(const MotorConstants& constants);

    /// No torque in the sample before.
    void rest() { torque_before_ = 0; }

    /// A sample with `torque` asked for and `volts` on the bus.
    Step drive(std::int32_t torque, double volts, Plant& plant) {
        const double asked = torque_before_ + (torque - torque_before_) * kRise;
        torque_before_ = torque;
        const double before = plant.velocity();
        const double given = reachable(asked, before, volts);
        plant.step(given);
        const double current = given * current_of_torque_;
        const double emf = emf_ / 2 * (before + plant.velocity());
        return {.squares = 1.5 * current * current,
                .watts = (emf + current * resistance_) * current * watts_of_one_};
    }
    /// A sample with shorted windings: they brake with the current that their EMF drives.
    Step brake(Plant& plant);

  private:
    /// Of a change of torque, what the current loop gives on the average of the sample: after n samples of
    /// its own 1 - (1 + 0.6 n) 0.4^n, with the coefficients from the box.
    static constexpr double kRise = 0.878;

    double reachable(double torque, double velocity, double volts) const {
        const double voltage = std::abs(emf_ * velocity) + (resistance_ + reactance_ * std::abs(velocity)) *
                                                               current_of_torque_ * std::abs(torque);
        if (voltage <= volts * range_of_volt_) return torque;
        return at_the_supplys_limit(torque, velocity, volts);
    }
    double at_the_supplys_limit(double torque, double velocity, double volts) const;

    double emf_;        // a count/sample of the shaft
    double reactance_;  // a current unit and a count/sample
    double resistance_;
    double current_of_torque_;
    double range_of_volt_;  // of the voltage registers, a volt of the supply
    double watts_of_one_;   // three phases' with an amplitude of one voltage and one current unit
    double torque_before_ = 0;
};

}  // namespace nplc::sim
