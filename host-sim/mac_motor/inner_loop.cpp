#include "sim/inner_loop.h"

#include <algorithm>
#include <array>

namespace nplc::sim {
namespace {

constexpr std::int32_t kMarkWidth = 8;  // counts between the hall mark forwards and backwards, ours

/// A 12 bit converter's half that the motor uses: 0 down to -2047.
std::int32_t converted(double current, std::int32_t middle) {
    constexpr std::int32_t kSpan = 2047, kFar = 100'000;
    const double bounded =
        std::clamp<double>(current + kFar, 0, 2 * kFar) + 0.5;  // so that a cast rounds down
    return std::clamp(static_cast<std::int32_t>(bounded) - kFar - middle, -kSpan, 0);
}

}  // namespace

InnerLoop::InnerLoop(registers::Model model)
    : constants_(constants_of(model)),
      mac800_(is_mac800(model)),
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

void InnerLoop::sense(std::int64_t counts) {
    v_eldeg_ = static_cast<std::int32_t>(std::clamp<std::int64_t>(counts - counts_, -0x7FFF, 0x7FFF));
    counts_ = counts;
    turn(v_eldeg_);
    PerPhase<std::int32_t> raw;
    for (std::size_t p = 0; p < kPhases; ++p) raw[p] = converted(winding_.currents()[p], kMiddle[p]);
    regulator_.measure(raw);
}

// 001 §3.2.124, §3.2.125, §3.2.36: at the mark the motor takes the register for its angle.
void InnerLoop::turn(std::int32_t by) {
    const std::int32_t whole = constants_.counts_a_field;
    const std::int32_t behind = angle_ >= whole - kMarkWidth ? angle_ - whole : angle_;
    const bool forwards = angle_ + by >= whole;
    const bool backwards = behind + by < -kMarkWidth;
    if (!mac800_ && (forwards || backwards) && (hall_.always || !at_mark_)) {
        shift_ = forwards ? hall_.eldegp_offset : hall_.eldegn_offset + kMarkWidth;
        at_mark_ = true;
    }
    angle_ += by;
    if (angle_ >= whole || angle_ < 0) angle_ = ((angle_ % whole) + whole) % whole;
}

std::int32_t InnerLoop::eldeg() const {
    constexpr std::int32_t kTurn = CurrentRegulator::kTurn;
    const std::int32_t eldeg = mac800_ ? angle_ * kTurn / 2000 + hall_.eldegp_offset : angle_ + shift_;
    return eldeg & (kTurn - 1);
}

std::int32_t InnerLoop::table_angle(std::int32_t angle) const {
    const std::int32_t whole = constants_.counts_a_field;
    const std::int32_t on_turn = angle >= whole ? angle - whole : angle < 0 ? angle + whole : angle;
    return mac800_ ? on_turn * SineTable::kTurn / 2000 : on_turn;
}

void InnerLoop::drive_torque(std::int32_t torque) {
    regulator_.commutate(torque, eldeg(), v_eldeg_);
    regulator_.regulate();
}

void InnerLoop::drive_field(std::int32_t i_nom, std::int32_t angle) {
    regulator_.aim(i_nom, angle);
    regulator_.regulate();
}

double InnerLoop::move(Plant& plant, double supply_volts) {
    supply_volts_ = supply_volts;
    const double velocity = plant.velocity();
    const std::int32_t middle = table_angle(angle_ + static_cast<std::int32_t>(velocity * 0.5));
    const Winding::Step step =
        winding_.step(regulator_.voltage(), supply_volts / constants_.nominal_volts, middle, velocity);
    plant.step(step.torque);
    return step.power * constants_.volts_of_one * constants_.amperes_of_one;
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

double InnerLoop::squares() const {
    double sum = 0;
    for (const double current : regulator_.measured()) sum += current * current;
    return sum;
}

double InnerLoop::regenerated() const {
    double sum = 0;
    for (std::size_t p = 0; p < kPhases; ++p) sum -= regulator_.measured()[p] * regulator_.voltage()[p];
    const double watts =
        sum * constants_.volts_of_one * constants_.amperes_of_one * supply_volts_ / constants_.nominal_volts;
    return std::max(watts, 0.0);
}

}  // namespace nplc::sim
