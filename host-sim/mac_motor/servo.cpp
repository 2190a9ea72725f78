#include "sim/servo.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/bounds.h"
#include "sim/motor_inputs.h"

namespace nplc::sim {
namespace {

constexpr double kAtLimit = 10000;  // I2T and UIT at the continuous rating: the limits' default

int steps_of(Servo::Depth depth) {
    return depth == Servo::Depth::current_loop ? kInnerSamples : 1;
}

bool hall_int(const MotorMemory& memory) {
    constexpr std::int32_t kHallInt = 1 << 5;  // CNTRL_BITS
    return !is_mac800(memory.model()) && (memory.get(cell::CNTRL_BITS) & kHallInt) != 0;
}

double kvout_of(const MotorMemory& memory) {
    if (is_mac800(memory.model())) return within(memory.get(cell::KVOUT) / 65536.0, 0, 255);
    return memory.get(cell::KVOUT) / 256.0;
}

/// Sum of the three squared currents at the continuous torque.
double nominal_squares_of(const MotorConstants& c) {
    const double nominal = c.full_current / 3;
    return 1.5 * nominal * nominal;
}

}  // namespace

Servo::Servo(registers::Model model, Depth depth, const Load& load)
    : constants_(constants_of(model)),
      depth_(depth),
      plant_(constants_.full_acceleration, steps_of(depth), load,
             depth == Depth::current_loop ? constants_.emf_inertia : 0),
      supply_(constants_.supply, constants_.outer_period / steps_of(depth)),
      inner_(model),
      quick_(constants_),
      heat_of_square_(kAtLimit / nominal_squares_of(constants_)),
      dumped_of_watt_(kAtLimit / constants_.dump_watts),
      copper_share_(constants_.outer_period / constants_.copper_seconds),
      dump_share_(constants_.outer_period / constants_.dump_seconds) {}

void Servo::power_up(MotorMemory& memory) {
    regulator_.reset();
    drive_ = {};
    torque_ = v_ist_ = test_samples_ = 0;
    asked_.fill(0);
    i2t_ = uit_ = 0;
    quick_.rest();
    last_counts_ = plant_.counts();
    supply_.settle();
    inner_.power_up(last_counts_);
    const int measured = is_mac800(memory.model()) ? 2 : 3;
    for (int p = 0; p < measured; ++p) {
        memory.set(cell::IA_OFFSET[p], InnerLoop::kMiddle[static_cast<std::size_t>(p)]);
    }
    use_settings(memory);
    show_sums(memory);
    show_currents(memory);
    show_supply(memory);
}

std::int32_t Servo::coast() {
    plant_.take_load();
    for (int n = 0; n < steps_of(depth_); ++n) plant_.step(0);
    const std::int64_t before = std::exchange(last_counts_, plant_.counts());
    return static_cast<std::int32_t>(last_counts_ - before);
}

/// Coefficients are recomputed only when one of their registers was written.
void Servo::use_settings(const MotorMemory& memory) {
    const Cell forwards = is_mac800(memory.model()) ? cell::ELDEG_OFFSET : cell::ELDEGP_OFFSET;
    constexpr std::int32_t kTurn = CurrentRegulator::kTurn;
    regulator_.use(regulator_coefficients(memory));
    kvout_ = kvout_of(memory);
    inner_.use(current_settings(memory), {.eldegp_offset = memory.get(forwards) & (kTurn - 1),
                                          .eldegn_offset = memory.get(cell::ELDEGN_OFFSET) & (kTurn - 1)});
}

std::int32_t Servo::advance(MotorMemory& memory, const Terminals& terminals, InnerWatcher* watcher) {
    if (memory.take_settings_written()) use_settings(memory);
    take_sums(memory);
    plant_.take_load();
    late_ = std::clamp(std::as_const(plant_).load().late_inner_samples, 0, Load::kLatest);
    if (depth_ == Depth::current_loop) {
        run_inner(memory, terminals, watcher);
    } else {
        run_outer(memory, terminals);
    }
    const std::int64_t counts = plant_.counts();
    v_ist_ = encoder_broken_ ? 0 : static_cast<std::int32_t>(counts - last_counts_);
    last_counts_ = counts;
    show_sums(memory);
    show_supply(memory);
    return v_ist_;
}

void Servo::run_inner(MotorMemory& memory, const Terminals& terminals, InnerWatcher* watcher) {
    // Most samples are controlled by torque and have no watcher: handled inside the loop.
    const bool by_torque = drive_.kind == Drive::Kind::velocity || drive_.kind == Drive::Kind::torque;
    const bool plain = by_torque && watcher == nullptr;
    double squares = 0;
    double regenerated = 0;
    inner_.use_every_mark(hall_int(memory));
    inner_.clear_at_the_end();
    const std::int32_t late = late_ % kInnerSamples;
    const std::int32_t torque = late_ == 0 ? torque_ : asked(late_ / kInnerSamples);
    const std::int32_t earlier = late == 0 ? torque : asked(late_ / kInnerSamples + 1);
    for (int n = 0; n < kInnerSamples; ++n) {
        inner_.sense(plant_.counts());
        const std::int32_t acting = n < late ? earlier : torque;
        if (plain) {
            inner_.drive_torque(acting);
        } else {
            set_voltages(memory, terminals, acting);
            if (watcher != nullptr) show_inner_sample(memory, *watcher);
        }
        squares += inner_.squares();
        if (supply_.dumping()) regenerated += inner_.regenerated();
        supply_.step(inner_.move(plant_, supply_.volts()));
    }
    constexpr double kShare = 1.0 / kInnerSamples;
    warm(squares * kShare, regenerated * kShare);
    show_currents(memory);
    if (drive_.kind == Drive::Kind::shorted) follow_offsets(memory);
}

void Servo::show_inner_sample(MotorMemory& memory, InnerWatcher& watcher) const {
    show_currents(memory);
    memory.set(cell::VF_OUT, torque_);
    show_supply(memory);
    watcher.inner_sample();
}

void Servo::set_voltages(const MotorMemory& memory, const Terminals& terminals, std::int32_t acting) {
    switch (drive_.kind) {
        case Drive::Kind::velocity:
        case Drive::Kind::torque:
            return inner_.drive_torque(acting);
        case Drive::Kind::analogue_torque:
            torque_ = analogue_torque(memory, terminals);
            return inner_.drive_torque(torque_);
        case Drive::Kind::field:
            return inner_.drive_field(man_i_nom_, man_alpha_);
        case Drive::Kind::voltage:
            if (test_samples_ == kTestSamples) break;
            ++test_samples_;
            return inner_.drive_voltage({umeas_, 0, -umeas_});
        case Drive::Kind::shorted:
            break;
    }
    inner_.drive_voltage({});
}

std::int32_t Servo::analogue_torque(const MotorMemory& memory, const Terminals& terminals) const {
    const registers::Model model = memory.model();
    const std::int64_t aninp = std::int64_t{analogue_register(model, terminals.millivolts(plant_.counts()))} +
                               memory.get(cell::ANINP_OFFSET);
    const std::int64_t full = analogue_register(model, 10'000);
    const std::int64_t limit = std::clamp(drive_.torque_limit, 0, kFullTorque);
    return static_cast<std::int32_t>(std::clamp(aninp * limit / full, -limit, limit));
}

void Servo::run_outer(const MotorMemory& memory, const Terminals& terminals) {
    if (drive_.kind == Drive::Kind::analogue_torque) torque_ = analogue_torque(memory, terminals);
    const bool driven = drive_.kind == Drive::Kind::velocity || drive_.kind == Drive::Kind::torque ||
                        drive_.kind == Drive::Kind::analogue_torque;
    const QuickLoop::Step step =
        driven ? quick_.drive(acting_torque(), supply_.volts(), plant_) : quick_.brake(plant_);
    const bool dumped = supply_.dumping() && step.watts < 0;
    supply_.step(step.watts);
    warm(step.squares, dumped ? -step.watts : 0);
}

/// Of a whole outer sample.
double Servo::acting_torque() const {
    if (late_ == 0) return torque_;
    const double earlier = static_cast<double>(late_ % kInnerSamples) / kInnerSamples;
    const std::int32_t ago = late_ / kInnerSamples;
    return asked(ago) * (1 - earlier) + asked(ago + 1) * earlier;
}

Servo::Result Servo::carry_out(const Drive& drive, MotorMemory& memory) {
    const bool regulated = drive.kind == Drive::Kind::velocity;
    const Regulator::Output out = regulated ? regulator_.step(regulator_input(drive))
                                            : Regulator::Output{.torque = unregulated_torque(drive, memory)};
    drive_ = drive;
    torque_ = out.torque;
    asked_[asked_next_] = torque_;
    asked_next_ = (asked_next_ + 1) % asked_.size();
    memory.set(cell::VF_OUT, torque_);
    memory.show_filters(out.ff_out, out.vb_out);
    return {out.torque, out.correction};
}

Regulator::Input Servo::regulator_input(const Drive& drive) const {
    return {.fnc_out = drive.fnc_out,
            .v_ist = v_ist_,
            .torque_limit = std::clamp(drive.torque_limit, 0, kFullTorque),
            .kvout = kvout_};
}

/// The speed regulator is passive. Uses the values of MANI and TESTU.
std::int32_t Servo::unregulated_torque(const Drive& drive, const MotorMemory& memory) {
    regulator_.reset();
    if (drive.kind != Drive::Kind::voltage || drive_.kind != Drive::Kind::voltage) test_samples_ = 0;
    switch (drive.kind) {
        case Drive::Kind::torque:
            return std::clamp(drive.torque, -kFullTorque, kFullTorque);
        case Drive::Kind::analogue_torque:
            return torque_;
        case Drive::Kind::field: {
            const std::int32_t i_nom = memory.get(cell::MAN_I_NOM);
            man_i_nom_ = std::clamp(is_mac800(memory.model()) ? i_nom / 65536 : i_nom, 0, kFullTorque);
            man_alpha_ = memory.get(cell::MAN_ALPHA) & (CurrentRegulator::kTurn - 1);
            return 0;
        }
        case Drive::Kind::voltage:
            umeas_ = std::clamp(memory.get(cell::UMEAS), -kFullTorque, kFullTorque);
            return 0;
        default:
            return 0;
    }
}

// 001 §3.2.140. R: by one per sample, so that currents of a turning shaft through the shorted windings
// average out.
void Servo::follow_offsets(MotorMemory& memory) const {
    const PerPhase<std::int32_t> currents = inner_.regulator().measured().integers();
    const int measured = is_mac800(memory.model()) ? 2 : 3;
    for (int p = 0; p < measured; ++p) {
        const std::int32_t current = currents[static_cast<std::size_t>(p)];
        if (current == 0) continue;
        memory.set(cell::IA_OFFSET[p], memory.get(cell::IA_OFFSET[p]) + (current > 0 ? -1 : 1));
    }
}

void Servo::show_currents(MotorMemory& memory) const {
    const CurrentRegulator& r = inner_.regulator();
    memory.set(cell::I_NOM, r.i_nom());
    memory.set(cell::PHI_SOLL, r.phi_soll());
    const PerPhase<std::int32_t> wanted = r.wanted().integers();
    const PerPhase<std::int32_t> measured = r.measured().integers();
    const PerPhase<std::int32_t> voltage = r.voltage().integers();
    for (int p = 0; p < 3; ++p) {
        const auto phase = static_cast<std::size_t>(p);
        memory.set(cell::IA_SOLL[p], wanted[phase]);
        memory.set(cell::IA_IST[p], measured[phase]);
        memory.set(cell::UA_VAL[p], voltage[phase]);
    }
    memory.set(cell::ELDEG_IST, inner_.eldeg());
    memory.set(cell::V_ELDEG, inner_.v_eldeg());
    if (!is_mac800(memory.model())) {
        constexpr std::int32_t kHallBits = 7 << 13;  // 001 §3.2.36
        const std::int32_t hall = static_cast<std::int32_t>(inner_.hall_bits()) << 13;
        memory.set(cell::CNTRL_BITS, (memory.get(cell::CNTRL_BITS) & ~kHallBits) | hall);
        return;
    }
    const PerPhase<std::int32_t> emf = inner_.emf();
    for (int p = 0; p < 3; ++p) memory.set(cell::EMK_A[p], emf[static_cast<std::size_t>(p)]);
}

// 001 §3.2.16, §3.2.18. R: leaky integrators that settle at 10000 with the continuous rating.
void Servo::warm(double squares, double regenerated) {
    i2t_ += (squares * heat_of_square_ - i2t_) * copper_share_;
    if (uit_ <= 0 && regenerated <= 0) return;
    uit_ += (regenerated * dumped_of_watt_ - uit_) * dump_share_;
}

/// Values written into the registers replace the integrators' state.
void Servo::take_sums(const MotorMemory& memory) {
    if (memory.get(cell::I2T) != i2t_shown_) i2t_ = memory.get(cell::I2T);
    if (memory.get(cell::UIT) != uit_shown_) uit_ = memory.get(cell::UIT);
}

void Servo::show_sums(MotorMemory& memory) {
    i2t_shown_ = memory.show(cell::I2T, i2t_);
    uit_shown_ = memory.show(cell::UIT, uit_);
}

void Servo::show_supply(MotorMemory& memory) const {
    constexpr double kDegree = 0.12207, kAir = 25, kLogicRegister = 24 * 74.4713;
    memory.show(cell::U_SUPPLY, supply_.volts() * constants_.volts_register + 0.5);
    if (!is_mac800(memory.model())) return;
    memory.show(cell::DEGC, (kAir + constants_.warming * i2t_ / kAtLimit) / kDegree);
    memory.show(cell::U_24V, kLogicRegister);
}

}  // namespace nplc::sim
