#include "sim/plant.h"

#include <algorithm>

#include "sim/mode_table.h"

namespace nplc::sim {
namespace {

constexpr double kFastest = 4096;  // counts/sample, 31,250 rpm on MAC50-141: limits extreme loads
constexpr std::int64_t kFarthest = std::int64_t{1} << 42;  // counts

/// Halves in an outer sample: the 15th root of 1/2.
double thrown_in(int steps) {
    return steps == 1 ? 0.5 : 0.9548;
}

std::int64_t edge_of(const MechanicalStop& stop) {
    return std::clamp(stop.counts, -kFarthest, kFarthest);
}

// 17.3E-6 kgm2 (001 §3.2.13) and a peak torque of 1.57 Nm give 869,000 rpm/s. 24 V peak a phase at 6000 rpm,
// so 1.57 Nm takes 27.4 A.
constexpr MotorConstants kSmall{
    .outer_period = 1.92e-3,
    .full_acceleration = 3500 / 16.0,
    .emf_inertia = 0.017,
    .counts_a_field = 2048,
    .full_current = 847,
    .resistance = 0.366,
    .decay = 0.9,
    .emf = 19.5,
    .volts_of_one = 24.0 / 1023,
    .amperes_of_one = 27.4 / 847,
    .nominal_volts = 48,
    .volts_register = 1 / 0.0537,
    .supply = {.source_volts = 48, .dump_volts = 52, .source_ohms = 0.2, .dump_ohms = 10, .farads = 2.2e-3},
    .dump_watts = 10,
    .dump_seconds = 10,
    .copper_seconds = 30,
    .warming = 0};

// 2,500 / 16 counts/sample^2 are 695,000 rpm/s. 162.5 V peak a phase at 4500 rpm,
// 52 counts of the inner loop; 6.8 Nm peak take 13.2 A.
constexpr MotorConstants kBig{
    .outer_period = 1.0 / 770,
    .full_acceleration = 2500 / 16.0,
    .emf_inertia = 0.0075,
    .counts_a_field = 2000,
    .full_current = 847,
    .resistance = 0.3,
    .decay = 0.95,
    .emf = 19.7,
    .volts_of_one = 162.5 / 1023,
    .amperes_of_one = 13.2 / 847,
    .nominal_volts = 325,
    .volts_register = 1 / 0.888798,
    .supply = {.source_volts = 325, .dump_volts = 400, .source_ohms = 1, .dump_ohms = 50, .farads = 470e-6},
    .dump_watts = 50,
    .dump_seconds = 20,
    .copper_seconds = 60,
    .warming = 60};

}  // namespace

Plant::Plant(double full_acceleration, int steps, const Load& load, double elsewhere)
    : acceleration_of_one_(full_acceleration / kFullTorque / steps / steps),
      elsewhere_256_(256 * elsewhere),
      steps_(steps),
      fastest_(kFastest / steps),
      slow_(kSlow / steps),
      thrown_(thrown_in(steps)),
      load_(load) {
    take_load();
}

void Plant::keep_within_stops(std::int64_t from) {
    if (const MechanicalStop* stop = stop_beyond()) press(*stop, from);
}

/// The stop that the shaft is in, if any.
const MechanicalStop* Plant::stop_beyond() const {
    if (load_.low_stop && position_ < edge_of(*load_.low_stop) * kCount) return &*load_.low_stop;
    if (load_.high_stop && position_ > edge_of(*load_.high_stop) * kCount) return &*load_.high_stop;
    return nullptr;
}

/// A spring in implicit steps, stable at any stiffness: the velocity results from the force at the end of the
/// step.
void Plant::press(const MechanicalStop& stop, std::int64_t from) {
    const std::int64_t edge = edge_of(stop) * kCount;
    if (stop.spring_1024 <= 0) {
        position_ = edge;
        velocity_ = 0;
        return;
    }
    constexpr double kSteepest = 128;
    const double torque = std::min(static_cast<double>(stop.spring_1024) / 1024, kTorqueBound);
    const double slope = std::min(torque * of_one_, kSteepest);
    const double depth = static_cast<double>(from - edge) / static_cast<double>(kCount);
    velocity_ = std::clamp((velocity_ - depth * slope) / (1 + slope), -fastest_, fastest_);
    if ((velocity_ > 0) != (depth + velocity_ > 0)) velocity_ *= thrown_;  // pushed out without rebound
    position_ = from + static_cast<std::int64_t>(velocity_ * static_cast<double>(kCount));
}

const MotorConstants& constants_of(registers::Model model) {
    return model == registers::Model::mac800 ? kBig : kSmall;
}

}  // namespace nplc::sim
