#include "sim/inner_loop.h"

#include <algorithm>
#include <array>

#include "sim/mode_table.h"

namespace nplc::sim {
namespace {

/// Of a winding, in voltage units for a current unit and a count/sample of the shaft.
double reactance_of(const MotorConstants& c) {
    constexpr double kTwoPi = 6.28318530717958647692;
    const double inner_samples = (1 + c.decay) / (2 * (1 - c.decay));  // L / R
    return kTwoPi / c.counts_a_field / kInnerSamples * inner_samples * c.resistance;
}

}  // namespace

void CurrentRegulator::reset() {
    apply({});
    wanted_ = measured_ = {};
    at_the_end_ = false;
}

void CurrentRegulator::apply(const PerPhase<std::int32_t>& voltage) {
    voltage_ = Phases(voltage).within(kRange);
    wanted_ = {};
    measured_before_ = error_before_ = output_ = output_before_ = {};
    i_nom_ = phi_ = 0;
}

CurrentRegulator::Settings current_settings(const MotorMemory& memory) {
    const bool big = is_mac800(memory.model());
    const double if_one = big ? 65536 : 4096;
    const double ib_one = big ? 16777216 : 256;
    CurrentRegulator::Settings s;
    s.kifx2 = Phases(memory.get(cell::KIFX2) / if_one);
    s.kifx1 = Phases(memory.get(cell::KIFX1) / if_one);
    s.kify1 = Phases(memory.get(cell::KIFY1) / if_one);
    s.kify0 = Phases(memory.get(cell::KIFY0) / if_one);
    s.kib1 = Phases(memory.get(cell::KIB1) / ib_one);
    s.kib0 = Phases(memory.get(cell::KIB0) / ib_one);
    s.amplitude = memory.get(cell::AMPLITUDE) / 256.0;
    s.phase_comp_256 = memory.get(cell::PHASE_COMP);
    s.third_is_rest = big;
    const int measured = big ? 2 : 3;
    PerPhase<double> gain{1, 1, 1};
    PerPhase<double> offset{};
    for (int p = 0; p < measured; ++p) {
        gain[static_cast<std::size_t>(p)] = memory.get(cell::KIA[p]) / 256.0;
        offset[static_cast<std::size_t>(p)] = memory.get(cell::IA_OFFSET[p]) & 0xFFFF;
    }
    s.gain = Phases(gain);
    s.offset = Phases(offset);
    return s;
}

InnerLoop::InnerLoop(registers::Model model)
    : constants_(constants_of(model)),
      mac800_(is_mac800(model)),
      per_nominal_(1 / constants_.nominal_volts),
      watts_of_one_(constants_.volts_of_one * constants_.amperes_of_one),
      winding_({.resistance = constants_.resistance,
                .decay = constants_.decay,
                .emf = constants_.emf,
                .torque = CurrentRegulator::kRange / constants_.full_current}) {}

void InnerLoop::use(const CurrentRegulator::Settings& settings, const HallSettings& hall) {
    regulator_.use(settings);
    hall_ = hall;
}

void InnerLoop::power_up(std::int64_t counts) {
    regulator_.reset();
    winding_.rest();
    const std::int64_t turn = constants_.counts_a_field;
    counts_ = counts;
    angle_ = static_cast<std::int32_t>(((counts % turn) + turn) % turn);
    shift_ = v_eldeg_ = 0;
    at_mark_ = false;
}

// 001 §3.2.124, §3.2.125, §3.2.36: at the mark the motor sets its angle from the register.
void InnerLoop::turn_at_the_mark(std::int32_t by) {
    const std::int32_t whole = constants_.counts_a_field;
    const std::int32_t behind = angle_ >= whole - kMarkWidth ? angle_ - whole : angle_;
    const bool forwards = angle_ + by >= whole;
    if (forwards || behind + by < -kMarkWidth) pass_mark(forwards);
    angle_ = (((angle_ + by) % whole) + whole) % whole;
}

void InnerLoop::pass_mark(bool forwards) {
    if (mac800_ || (at_mark_ && !every_mark_)) return;
    shift_ = forwards ? hall_.eldegp_offset : hall_.eldegn_offset + kMarkWidth;
    at_mark_ = true;
}

void InnerLoop::drive_field(std::int32_t i_nom, std::int32_t angle) {
    regulator_.aim(i_nom, angle);
    regulator_.regulate();
}

std::uint32_t InnerLoop::hall_bits() const {
    constexpr std::array<std::uint8_t, 6> kStates{1, 3, 2, 6, 4, 5};
    return kStates[static_cast<std::size_t>(angle_ * 6 / constants_.counts_a_field)];
}

PerPhase<std::int32_t> InnerLoop::emf() const {
    const double field = constants_.emf * v_eldeg_;
    return (kSine.phases(table_angle(angle_)) * field).integers();
}

double InnerLoop::regenerated() const {
    const double sum = -(regulator_.measured() * regulator_.voltage()).sum();
    const double watts =
        sum * constants_.volts_of_one * constants_.amperes_of_one * supply_volts_ / constants_.nominal_volts;
    return std::max(watts, 0.0);
}

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
