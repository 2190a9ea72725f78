#include "macreg/prediction.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "registers/mac.h"
#include "sim/axis_load.h"
#include "sim/mac_motor.h"

namespace nplc::macreg {
namespace {

using registers::Model;

constexpr double kLeastKvout = 1, kMostKvout = 10;  // 001 §3.2.13
constexpr int kSamples = 900;
constexpr double kAtRest = 3;         // counts
constexpr double kOvershoot = 8;      // counts; up to here no gain is reduced
constexpr double kTorqueShare = 700;  // of 1023, that the move's acceleration takes

std::uint8_t gain_register(Model model) {
    return registers::find(model, model == Model::mac800 ? "KVFX6" : "KVFX4")->number;
}

std::int64_t box_gain(Model model) {
    return sim::MacMotor(model).read(gain_register(model));
}

std::int32_t kvout_raw(Model model, double kvout) {
    return static_cast<std::int32_t>(std::lround(kvout * (model == Model::mac800 ? 65536 : 256)));
}

struct Move {
    double turn;
    std::int32_t v_soll;
    std::int32_t a_soll;
};

Response response_to(const Move& move, const plant_file::Plant& plant, Model model, double kvout,
                     std::int64_t gain) {
    sim::MacMotorOptions options;
    options.depth = sim::Servo::Depth::outer_loop;
    options.load = sim::load_of(plant, model);
    sim::MacMotor motor(model, options);
    Response out{.kvout = kvout, .gain = gain};
    motor.write(registers::KVOUT, kvout_raw(model, kvout));
    motor.write(gain_register(model), static_cast<std::int32_t>(gain));
    motor.write(registers::V_SOLL, move.v_soll);
    motor.write(registers::A_SOLL, move.a_soll);
    motor.write(registers::MODE_REG, 2);  // first held at its position: a load may pull
    for (int i = 0; i < kSamples / 3; ++i) motor.sample();
    const std::int32_t target = motor.read(registers::P_SOLL) + static_cast<std::int32_t>(move.turn);
    motor.write(registers::P_SOLL, target);
    const double period = std::chrono::duration<double>(motor.sample_period()).count();
    for (int i = 0; i < kSamples; ++i) {
        motor.sample();
        out.time_s.push_back(i * period);
        out.position.push_back(motor.p_ist() - target + move.turn);
        out.torque.push_back(motor.torque());
        out.overshoot = std::max(out.overshoot, out.position.back() - move.turn);
        out.peak_torque = std::max(out.peak_torque, std::abs(out.torque.back()));
    }
    const auto away = std::find_if(out.position.rbegin(), out.position.rend(),
                                   [&](double position) { return std::abs(position - move.turn) > kAtRest; });
    const auto samples = out.position.rend() - away;
    out.settled_s = samples < kSamples ? static_cast<double>(samples) * period : 0;
    return out;
}

bool is_better(const Response& one, const Response& other) {
    if ((one.settled_s > 0) != (other.settled_s > 0)) return one.settled_s > 0;
    if (std::max(one.overshoot, other.overshoot) <= kOvershoot) return false;
    return one.overshoot < other.overshoot - 1;
}

}  // namespace

Tuning tuning_for(const plant_file::Plant& plant, Model model) {
    const plant_file::Load load = plant_file::in_motor_terms(plant, model);
    const double ratio = load.inertia.value_or(1);
    const double own = 1023 / sim::constants_of(model).full_acceleration;
    Tuning tuning;
    Move move{.turn = static_cast<double>(registers::scale_of(model).counts_per_rev),
              .v_soll = 1600,
              .a_soll = static_cast<std::int32_t>(std::clamp(16 * kTorqueShare / (own * ratio), 4.0, 160.0))};
    tuning.turn = move.turn;
    tuning.v_soll = move.v_soll;
    tuning.a_soll = move.a_soll;
    const double kvout = std::round(256 * std::clamp(ratio, kLeastKvout, kMostKvout)) / 256;
    const std::int64_t gain = box_gain(model);
    tuning.now = response_to(move, plant, model, 1, gain);
    tuning.then = response_to(move, plant, model, kvout, gain);
    for (const double share : {0.85, 0.7, 0.5, 0.35, 0.25}) {
        Response other =
            response_to(move, plant, model, kvout,
                        std::max<std::int64_t>(1, std::llround(share * static_cast<double>(gain))));
        if (is_better(other, tuning.then)) tuning.then = std::move(other);
    }
    if (ratio > kMostKvout)
        tuning.remark = fmt::format(
            "the inertia is {:.1f} times the motor's own and KVOUT's recommended range ends at 10.0 (001 "
            "§3.2.13): a gear "
            "between motor and load, or a greater motor, would be steadier",
            ratio);
    else if (tuning.then.settled_s == 0)
        tuning.remark = "with none of these gains the virtual motor comes to rest; is the dead time right?";
    return tuning;
}

}  // namespace nplc::macreg
