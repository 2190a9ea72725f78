#include "sim/servo.h"

#include <algorithm>
#include <cmath>

#include "sim/analogue_input.h"
#include "sim/bounds.h"

namespace nplc::sim {
namespace {

constexpr std::int32_t kFullTorque = 1023;
constexpr double kAtLimit = 10000;  // I2T and UIT at what is borne for ever: the limits' default
constexpr int kOuterSteps = 3;      // of the shaft in an outer sample, without the current loop

/// Of a new torque, what the current loop gives on the average of each third of the sample: after n samples
/// of its own 1 - (1 + 0.6 n) 0.4^n, with the coefficients from the box.
constexpr std::array<double, kOuterSteps> kRise{0.644, 0.989, 1.000};

bool hall_int(const MotorMemory& memory) {
    constexpr std::int32_t kHallInt = 1 << 5;  // CNTRL_BITS
    return !is_mac800(memory.model()) && (memory.get(cell::CNTRL_BITS) & kHallInt) != 0;
}

double kvout_of(const MotorMemory& memory) {
    if (is_mac800(memory.model())) return within(memory.get(cell::KVOUT) / 65536.0, 0, 255);
    return memory.get(cell::KVOUT) / 256.0;
}

/// Of a winding, in voltage units for a current unit and a count/step of the shaft.
double reactance_of(const MotorConstants& c) {
    constexpr double kTwoPi = 6.28318530717958647692;
    const double inner_samples = (1 + c.decay) / (2 * (1 - c.decay));  // L / R
    return kTwoPi / c.counts_a_field * kOuterSteps / kInnerSamples * inner_samples * c.resistance;
}

/// Of the three currents, at the torque that is borne for ever.
double nominal_squares_of(const MotorConstants& c) {
    const double nominal = c.full_current / 3;
    return 1.5 * nominal * nominal;
}

std::int32_t rounded(double value) {
    constexpr double kMost = 2'000'000'000;
    return static_cast<std::int32_t>(within(value, kMost));
}

}  // namespace

Servo::Servo(registers::Model model, Depth depth, const Load& load)
    : constants_(constants_of(model)),
      depth_(depth),
      plant_(constants_.full_acceleration, depth == Depth::current_loop ? kInnerSamples : kOuterSteps, load,
             depth == Depth::current_loop ? constants_.emf_inertia : 0),
      supply_(constants_.supply,
              constants_.outer_period / (depth == Depth::current_loop ? kInnerSamples : kOuterSteps)),
      inner_(model),
      emf_(constants_.emf * kOuterSteps / kInnerSamples),
      reactance_(reactance_of(constants_)),
      current_of_torque_(constants_.full_current / kFullTorque),
      nominal_squares_(nominal_squares_of(constants_)),
      copper_share_(constants_.outer_period / constants_.copper_seconds),
      dump_share_(constants_.outer_period / constants_.dump_seconds) {}

void Servo::power_up(MotorMemory& memory) {
    regulator_.reset();
    drive_ = {};
    torque_ = v_ist_ = test_samples_ = 0;
    torque_before_ = i2t_ = uit_ = 0;
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

/// Coefficients are worked out anew only when one of their registers was written.
void Servo::take_settings(MotorMemory& memory) {
    const bool written = memory.take_settings_written();
    if (written || hall_int_ != hall_int(memory)) use_settings(memory);
}

void Servo::use_settings(const MotorMemory& memory) {
    const Cell forwards = is_mac800(memory.model()) ? cell::ELDEG_OFFSET : cell::ELDEGP_OFFSET;
    constexpr std::int32_t kTurn = CurrentRegulator::kTurn;
    hall_int_ = hall_int(memory);
    regulator_.use(regulator_coefficients(memory));
    inner_.use(current_settings(memory), {.eldegp_offset = memory.get(forwards) & (kTurn - 1),
                                          .eldegn_offset = memory.get(cell::ELDEGN_OFFSET) & (kTurn - 1),
                                          .always = hall_int_});
}

std::int32_t Servo::advance(MotorMemory& memory, const Terminals& terminals, InnerWatcher* watcher) {
    take_settings(memory);
    take_sums(memory);
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
    const bool by_torque = drive_.kind == Drive::Kind::velocity || drive_.kind == Drive::Kind::torque;
    double squares = 0;
    double regenerated = 0;
    inner_.clear_at_the_end();
    for (int n = 0; n < kInnerSamples; ++n) {
        inner_.sense(plant_.counts());
        if (by_torque) {  // by far the most of all samples: in the loop itself
            inner_.drive_torque(torque_);
        } else {
            set_voltages(memory, terminals);
        }
        if (watcher != nullptr) {
            show_currents(memory);
            memory.set(cell::VF_OUT, torque_);
            show_supply(memory);
            watcher->inner_sample();
        }
        squares += inner_.squares();
        if (supply_.dumping()) regenerated += inner_.regenerated();
        supply_.step(inner_.move(plant_, supply_.volts()));
    }
    warm(squares / kInnerSamples, regenerated / kInnerSamples);
    show_currents(memory);
    if (drive_.kind == Drive::Kind::shorted) follow_offsets(memory);
}

void Servo::set_voltages(const MotorMemory& memory, const Terminals& terminals) {
    switch (drive_.kind) {
        case Drive::Kind::velocity:
        case Drive::Kind::torque:
            return inner_.drive_torque(torque_);
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

/// The sample in thirds, the current loop replaced by what it does with the coefficients from the box.
void Servo::run_outer(const MotorMemory& memory, const Terminals& terminals) {
    if (drive_.kind == Drive::Kind::analogue_torque) torque_ = analogue_torque(memory, terminals);
    const bool driven = drive_.kind == Drive::Kind::velocity || drive_.kind == Drive::Kind::torque ||
                        drive_.kind == Drive::Kind::analogue_torque;
    double squares = 0;
    double regenerated = 0;
    for (const double rise : kRise) {
        const double emf = emf_ * plant_.velocity();
        if (!driven) {  // a shorted winding brakes with the current that its EMF drives through it
            const double current = emf / constants_.resistance;
            plant_.step(0, emf_ / constants_.resistance * kFullTorque / constants_.full_current);
            supply_.step(0);
            squares += 1.5 * current * current;
            continue;
        }
        const double torque = reachable(torque_before_ + (torque_ - torque_before_) * rise);
        const double current = torque * current_of_torque_;
        const double watts = 1.5 * (emf + current * constants_.resistance) * current *
                             constants_.volts_of_one * constants_.amperes_of_one;
        squares += 1.5 * current * current;
        if (supply_.dumping()) regenerated += std::max(-watts, 0.0);
        supply_.step(watts);
        plant_.step(torque);
    }
    torque_before_ = driven ? torque_ : 0;
    warm(squares / kOuterSteps, regenerated / kOuterSteps);
}

/// What the supply can drive against the EMF, through resistance and inductance.
double Servo::reachable(double torque) const {
    const double available = CurrentRegulator::kRange * supply_.volts() / constants_.nominal_volts;
    const double sign = torque < 0 ? -1 : 1;
    const double emf = emf_ * plant_.velocity() * sign;
    const double reactance = std::abs(reactance_ * plant_.velocity());
    const double current = torque * sign * current_of_torque_;
    if (std::abs(emf) + (constants_.resistance + reactance) * current <= available) return torque;
    const double square = constants_.resistance * constants_.resistance + reactance * reactance;
    const double along = emf * constants_.resistance;
    const double spare = emf * emf - available * available;
    if (square * current * current + 2 * along * current + spare <= 0) return torque;
    const double root = along * along - square * spare;
    const double most = root <= 0 ? 0 : std::max((std::sqrt(root) - along) / square, 0.0);
    return sign * std::min(current, most) / current_of_torque_;
}

Servo::Result Servo::carry_out(const Drive& drive, MotorMemory& memory) {
    if (drive.kind != Drive::Kind::voltage || drive_.kind != Drive::Kind::voltage) test_samples_ = 0;
    drive_ = drive;
    Regulator::Output out;
    const std::int32_t limit = std::clamp(drive.torque_limit, 0, kFullTorque);
    if (drive.kind == Drive::Kind::velocity) {
        out = regulator_.step(
            {.fnc_out = drive.fnc_out, .v_ist = v_ist_, .torque_limit = limit, .kvout = kvout_of(memory)});
    } else {
        regulator_.reset();
    }
    switch (drive.kind) {
        case Drive::Kind::torque:
            out.torque = std::clamp(drive.torque, -kFullTorque, kFullTorque);
            break;
        case Drive::Kind::analogue_torque:
            out.torque = torque_;
            break;
        case Drive::Kind::field: {
            const std::int32_t i_nom = memory.get(cell::MAN_I_NOM);
            man_i_nom_ = std::clamp(is_mac800(memory.model()) ? i_nom / 65536 : i_nom, 0, kFullTorque);
            man_alpha_ = memory.get(cell::MAN_ALPHA) & (CurrentRegulator::kTurn - 1);
            break;
        }
        case Drive::Kind::voltage:
            umeas_ = std::clamp(memory.get(cell::UMEAS), -kFullTorque, kFullTorque);
            break;
        default:
            break;
    }
    torque_ = out.torque;
    memory.set(cell::VF_OUT, torque_);
    memory.show(cell::FF_OUT, rounded(out.ff_out));
    memory.show(cell::VB_OUT, rounded(out.vb_out));
    return {out.torque, out.correction};
}

// 001 §3.2.140. R: by one a sample, so that what a turning shaft drives through the shorted windings averages
// out.
void Servo::follow_offsets(MotorMemory& memory) const {
    const int measured = is_mac800(memory.model()) ? 2 : 3;
    for (int p = 0; p < measured; ++p) {
        const std::int32_t current = inner_.regulator().measured()[static_cast<std::size_t>(p)];
        if (current == 0) continue;
        memory.set(cell::IA_OFFSET[p], memory.get(cell::IA_OFFSET[p]) + (current > 0 ? -1 : 1));
    }
}

void Servo::show_currents(MotorMemory& memory) const {
    const CurrentRegulator& r = inner_.regulator();
    memory.set(cell::I_NOM, r.i_nom());
    memory.set(cell::PHI_SOLL, r.phi_soll());
    for (int p = 0; p < 3; ++p) {
        const auto phase = static_cast<std::size_t>(p);
        memory.show(cell::IA_SOLL[p], r.wanted()[phase]);
        memory.set(cell::IA_IST[p], r.measured()[phase]);
        memory.set(cell::UA_VAL[p], r.voltage()[phase]);
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

// 001 §3.2.16, §3.2.18. R: leaky sums that come to rest at 10000 with what is borne for ever.
void Servo::warm(double squares, double regenerated) {
    const double heat = squares / nominal_squares_ * kAtLimit;
    i2t_ += (heat - i2t_) * copper_share_;
    const double dumped = regenerated / constants_.dump_watts * kAtLimit;
    uit_ += (dumped - uit_) * dump_share_;
}

/// What was written into the registers since is what the sums go on from.
void Servo::take_sums(const MotorMemory& memory) {
    if (memory.get(cell::I2T) != i2t_shown_) i2t_ = memory.get(cell::I2T);
    if (memory.get(cell::UIT) != uit_shown_) uit_ = memory.get(cell::UIT);
}

void Servo::show_sums(MotorMemory& memory) {
    memory.show(cell::I2T, rounded(i2t_));
    memory.show(cell::UIT, rounded(uit_));
    i2t_shown_ = memory.get(cell::I2T);
    uit_shown_ = memory.get(cell::UIT);
}

void Servo::show_supply(MotorMemory& memory) const {
    constexpr double kDegree = 0.12207, kAir = 25, kLogicRegister = 24 * 74.4713;
    memory.set(cell::U_SUPPLY, rounded(supply_.volts() * constants_.volts_register + 0.5));
    if (!is_mac800(memory.model())) return;
    memory.set(cell::DEGC, rounded((kAir + constants_.warming * i2t_ / kAtLimit) / kDegree));
    memory.set(cell::U_24V, rounded(kLogicRegister));
}

}  // namespace nplc::sim
