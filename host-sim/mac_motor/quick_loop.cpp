#include "sim/quick_loop.h"

#include <algorithm>

#include "sim/current_regulator.h"
#include "sim/drive.h"

namespace nplc::sim {
namespace {

/// Of a winding, in voltage units for a current unit and a count/sample of the shaft.
double reactance_of(const MotorConstants& c) {
    constexpr double kTwoPi = 6.28318530717958647692;
    const double inner_samples = (1 + c.decay) / (2 * (1 - c.decay));  // L / R
    return kTwoPi / c.counts_a_field / kInnerSamples * inner_samples * c.resistance;
}

}  // namespace

QuickLoop::QuickLoop(const MotorConstants& constants)
    : emf_(constants.emf / kInnerSamples),
      reactance_(reactance_of(constants)),
      resistance_(constants.resistance),
      current_of_torque_(constants.full_current / kFullTorque),
      range_of_volt_(CurrentRegulator::kRange / constants.nominal_volts),
      watts_of_one_(1.5 * constants.volts_of_one * constants.amperes_of_one) {}

QuickLoop::Step QuickLoop::brake(Plant& plant) {
    rest();
    const double emf = emf_ * plant.velocity();
    const double reactance = reactance_ * plant.velocity();
    const double square = resistance_ * resistance_ + reactance * reactance;
    const double conductance = emf_ * resistance_ / square;
    plant.step(0, conductance / current_of_torque_);
    return {.squares = 1.5 * emf * emf / square, .watts = 0};
}

/// Through resistance and inductance, against the EMF.
double QuickLoop::at_the_supplys_limit(double torque, double velocity, double volts) const {
    const double available = volts * range_of_volt_;
    const double sign = torque < 0 ? -1 : 1;
    const double emf = emf_ * velocity * sign;
    const double reactance = std::abs(reactance_ * velocity);
    const double current = torque * sign * current_of_torque_;
    const double square = resistance_ * resistance_ + reactance * reactance;
    const double along = emf * resistance_;
    const double spare = emf * emf - available * available;
    if (square * current * current + 2 * along * current + spare <= 0) return torque;
    const double root = along * along - square * spare;
    const double most = root <= 0 ? 0 : std::max((std::sqrt(root) - along) / square, 0.0);
    return sign * std::min(current, most) / current_of_torque_;
}

}  // namespace nplc::sim
