#include "sim/inner_loop.h"

#include <algorithm>
#include <array>

namespace nplc::sim {

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

void InnerLoop::pass_mark(bool forwards) {
    if (mac800_ || (at_mark_ && !hall_.always)) return;
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
    PerPhase<std::int32_t> emf;
    const PerPhase<double> shapes = kSine.phases(table_angle(angle_));
    for (std::size_t p = 0; p < kPhases; ++p) {
        emf[p] = static_cast<std::int32_t>(constants_.emf * v_eldeg_ * shapes[p]);
    }
    return emf;
}

double InnerLoop::regenerated() const {
    double sum = 0;
    for (std::size_t p = 0; p < kPhases; ++p) sum -= regulator_.measured()[p] * regulator_.voltage()[p];
    const double watts =
        sum * constants_.volts_of_one * constants_.amperes_of_one * supply_volts_ / constants_.nominal_volts;
    return std::max(watts, 0.0);
}

}  // namespace nplc::sim
