#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "sim/bounds.h"
#include "sim/motor_memory.h"
#include "sim/plant.h"

namespace nplc::sim {

inline constexpr std::size_t kPhases = 3;
/// Phases A, B and C.
template <class T>
using PerPhase = std::array<T, kPhases>;

/// One number per phase, computed together. A and B share a vector register: the same results as with three
/// doubles, in fewer instructions.
class Phases {
  public:
    Phases() = default;
    Phases(double a, double b, double c) : ab_{a, b}, c_(c) {}
    explicit Phases(double all) : Phases(all, all, all) {}
    explicit Phases(const PerPhase<std::int32_t>& p)
        : Phases(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])) {}
    explicit Phases(const PerPhase<double>& p) : Phases(p[0], p[1], p[2]) {}

    double a() const { return ab_[0]; }
    double b() const { return ab_[1]; }
    double c() const { return c_; }
    double sum() const { return ab_[0] + ab_[1] + c_; }
    PerPhase<std::int32_t> integers() const { return {integer(ab_[0]), integer(ab_[1]), integer(c_)}; }

    /// As `nearest` of bounds.h.
    Phases nearest() const { return (*this + kNoFraction) - kNoFraction; }
    bool inside(double limit) const {
        const bool all = std::abs(a()) <= limit && std::abs(b()) <= limit && std::abs(c_) <= limit;
        return __builtin_expect_with_probability(all, 1, 0.999);
    }
    Phases clamped(double low, double high) const {
        const auto one = [&](double value) { return std::clamp(value, low, high); };
        return {one(a()), one(b()), one(c_)};
    }
    /// As `within` of bounds.h.
    Phases within(double limit) const { return inside(limit) ? *this : clamped(-limit, limit); }

    friend Phases operator+(Phases x, Phases y) { return {x.ab_ + y.ab_, x.c_ + y.c_}; }
    friend Phases operator-(Phases x, Phases y) { return {x.ab_ - y.ab_, x.c_ - y.c_}; }
    friend Phases operator*(Phases x, Phases y) { return {x.ab_ * y.ab_, x.c_ * y.c_}; }
    friend Phases operator+(Phases x, double y) { return {x.ab_ + y, x.c_ + y}; }
    friend Phases operator-(Phases x, double y) { return {x.ab_ - y, x.c_ - y}; }
    friend Phases operator*(Phases x, double y) { return {x.ab_ * y, x.c_ * y}; }

  private:
    using Pair [[gnu::vector_size(16)]] = double;

    Phases(Pair ab, double c) : ab_(ab), c_(c) {}
    static std::int32_t integer(double value) { return static_cast<std::int32_t>(value); }

    Pair ab_{};
    double c_ = 0;
};

/// A field revolution in the registers' 2048 steps. Computed at compile time, by additions and
/// multiplications: the same on every machine.
class SineTable {
  public:
    static constexpr std::int32_t kTurn = 2048;

    constexpr SineTable() {
        constexpr double kPi = 3.14159265358979323846;
        for (std::int32_t i = 0; i <= kQuarter; ++i) {
            const double angle = 2 * kPi * i / kTurn;
            double term = angle;
            double sum = angle;
            for (int n = 1; n <= 10; ++n) {
                term *= -angle * angle / ((2 * n) * (2 * n + 1));
                sum += term;
            }
            at(i) = at(2 * kQuarter - i) = sum;
            at(2 * kQuarter + i) = at(kTurn - i) = -sum;
        }
        at(0) = at(2 * kQuarter) = at(kTurn) = 0;
        for (std::int32_t i = 0; i <= kQuarter; ++i) at(kTurn + i) = at(i);
    }

    /// `amplitude` times the sines of `step`, 0 to 2047, and of 120 and 240 degrees more.
    Phases phases(std::int32_t step, double amplitude = 1) const {
        constexpr double kSine120 = 0.86602540378443864676;
        const double sine = values_[static_cast<std::size_t>(step)];
        const double half = sine * (0.5 * amplitude);
        const double third = values_[static_cast<std::size_t>(step + kQuarter)] * (kSine120 * amplitude);
        return {sine * amplitude, third - half, -third - half};
    }

  private:
    static constexpr std::int32_t kQuarter = kTurn / 4;

    constexpr double& at(std::int32_t step) { return values_[static_cast<std::size_t>(step)]; }

    std::array<double, kTurn + kQuarter + 1> values_{};
};

inline constexpr SineTable kSine{};

/// The motor's inner loop (001 §4.3): commutation, and per phase filter IB on the measured current, filter IF
/// on the error, with the motor's registers as coefficients. In the registers' units: currents 1023 at the
/// end of the measuring range, voltages 1023 at the whole supply, angles 2048 a turn of the field.
class CurrentRegulator {
  public:
    struct Settings {
        Phases kifx2, kifx1, kify1, kify0, kib1, kib0;  ///< the same three times
        double amplitude = 0;
        std::int64_t phase_comp_256 = 0;
        Phases gain{1, 1, 1};  ///< KIA, KIB, KIC
        Phases offset;
        bool third_is_rest = false;  ///< MAC800 measures two currents
    };
    static constexpr std::int32_t kRange = 1023;
    static constexpr std::int32_t kTurn = SineTable::kTurn;

    void use(const Settings& settings) { s_ = settings; }
    void reset();

    /// Currents as the converters give them, whole, without offset.
    void measure(Phases converted) {
        const Phases scaled = (converted + s_.offset) * s_.gain;
        const bool inside = scaled.inside(kRange - 1);
        measured_ = (inside ? scaled : scaled.clamped(-kRange, kRange)).nearest();
        if (s_.third_is_rest) {
            const double rest = within(-measured_.a() - measured_.b(), kRange);
            measured_ = {measured_.a(), measured_.b(), rest};
        } else if (inside) {
            return;
        }
        at_the_end_ |= !measured_.inside(kRange - 1);
    }
    /// A field of `torque` (with its sign) across the rotor at `eldeg`, which goes on by `v_eldeg` a sample.
    void commutate(std::int32_t torque, std::int32_t eldeg, std::int32_t v_eldeg) {
        const std::int64_t ahead = (v_eldeg * s_.phase_comp_256 + 128) >> 8;  // 001 §3.2.126
        const auto lead = static_cast<std::int32_t>(std::clamp(ahead, -kLargest, kLargest));
        const std::int32_t half_turn = torque < 0 ? kTurn / 2 : 0;
        aim(torque < 0 ? -torque : torque, eldeg + lead + half_turn);
    }
    /// A field of `i_nom` at `angle`.
    void aim(std::int32_t i_nom, std::int32_t angle) {
        i_nom_ = i_nom;
        phi_ = angle & (kTurn - 1);
        const double amplitude = i_nom * s_.amplitude;
        wanted_ = kSine.phases(phi_, amplitude);
        if (std::abs(amplitude) > kLargest) wanted_ = wanted_.within(kLargest);
        wanted_ = wanted_.nearest();
    }
    /// Regulates the measured currents to the wanted ones; the result is in `voltage`.
    void regulate() {
        const Phases error = wanted_ - (measured_ * s_.kib1 + measured_before_ * s_.kib0);
        const Phases kept = error_before_ * s_.kifx1 + output_ * s_.kify1 + output_before_ * s_.kify0;
        const Phases output = (error * s_.kifx2 + kept).within(kRange);  // anti-windup
        measured_before_ = measured_;
        error_before_ = error;
        output_before_ = output_;
        output_ = output;
        voltage_ = output.nearest();
    }
    /// No regulation: applies these voltages and clears the filters.
    void apply(const PerPhase<std::int32_t>& voltage);

    Phases wanted() const { return wanted_; }      ///< IA_SOLL ..., whole
    Phases measured() const { return measured_; }  ///< IA_IST ...
    Phases voltage() const { return voltage_; }    ///< UA_VAL ...
    std::int32_t i_nom() const { return i_nom_; }
    std::int32_t phi_soll() const { return phi_; }
    /// A current was at the end of its measuring range since the last clear.
    bool at_the_end() const { return at_the_end_; }
    void clear_at_the_end() { at_the_end_ = false; }

  private:
    static constexpr std::int64_t kLargest = 32767;

    Settings s_;
    Phases wanted_;
    Phases measured_;
    Phases voltage_;
    Phases measured_before_;
    Phases error_before_;
    Phases output_;
    Phases output_before_;
    std::int32_t i_nom_ = 0;
    std::int32_t phi_ = 0;
    bool at_the_end_ = false;
};

/// The loop's settings from the registers.
CurrentRegulator::Settings current_settings(const MotorMemory& memory);

/// Three windings in a star whose middle is open, on a rotor with a sinusoidal field. Currents and voltages
/// in the registers' units, the voltages at the nominal supply; a step is a sample of the inner loop.
class Winding {
  public:
    struct Constants {
        double resistance;  ///< voltage a current
        double decay;       ///< factor of a current per step without voltage: exp(-T R / L)
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
    /// counts/step. The torque is that of the mean current.
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

/// The current loop at its own rate, with windings and rotor (001 §1.2, §4.3). A sample is `sense`, one call
/// that sets voltages, then `move`.
class InnerLoop {
  public:
    struct HallSettings {
        std::int32_t eldegp_offset = 0;  ///< MAC800: ELDEG_OFFSET
        std::int32_t eldegn_offset = 0;
    };

    explicit InnerLoop(registers::Model model);

    /// HALL_INT: the mark counts every time, not only the first after power-up.
    void use_every_mark(bool every) { every_mark_ = every; }
    void use(const CurrentRegulator::Settings& settings, const HallSettings& hall);
    /// As after power-up: no currents. R: the rotor's angle is known at once.
    void power_up(std::int64_t counts);

    /// Reads currents and encoder.
    void sense(std::int64_t counts) {
        v_eldeg_ = static_cast<std::int32_t>(std::clamp<std::int64_t>(counts - counts_, -0x7FFF, 0x7FFF));
        counts_ = counts;
        turn(v_eldeg_);
        regulator_.measure(converted(winding_.currents()));
    }
    void drive_torque(std::int32_t torque) {
        regulator_.commutate(torque, eldeg(), v_eldeg_);
        regulator_.regulate();
    }
    void drive_field(std::int32_t i_nom, std::int32_t angle);
    void drive_voltage(const PerPhase<std::int32_t>& voltage) { regulator_.apply(voltage); }
    /// One sample. Returns the watts into the windings.
    double move(Plant& plant, double supply_volts) {
        supply_volts_ = supply_volts;
        const double velocity = plant.velocity();
        const std::int32_t middle = table_angle(angle_ + static_cast<std::int32_t>(velocity * 0.5));
        const Winding::Step step =
            winding_.step(regulator_.voltage(), supply_volts * per_nominal_, middle, velocity);
        plant.step(step.torque);
        return step.power * watts_of_one_;
    }

    const CurrentRegulator& regulator() const { return regulator_; }
    void clear_at_the_end() { regulator_.clear_at_the_end(); }
    std::int32_t eldeg() const {  ///< ELDEG_IST
        const std::int32_t eldeg =
            mac800_ ? angle_ * SineTable::kTurn / kBigField + hall_.eldegp_offset : angle_ + shift_;
        return eldeg & (SineTable::kTurn - 1);
    }
    std::int32_t v_eldeg() const { return v_eldeg_; }  ///< V_ELDEG
    std::uint32_t hall_bits() const;                   ///< the three hall elements, bit 0 to 2
    PerPhase<std::int32_t> emf() const;                ///< EMK_A ..., voltage units
    double squares() const {                           ///< IA_IST^2 + IB_IST^2 + IC_IST^2
        return (regulator_.measured() * regulator_.measured()).sum();
    }
    double regenerated() const;  ///< Preg of 001 §3.2.18, watts, 0 at the least

    /// The converters' output without current is the negative of this (own choice): the values found for
    /// IA_OFFSET ...
    static constexpr PerPhase<std::int32_t> kMiddle{1021, 1030, 1017};

  private:
    static constexpr std::int32_t kMarkWidth = 8;    // counts between the hall mark both ways, ours
    static constexpr std::int32_t kBigField = 2000;  // MAC800's counts_a_field

    /// A converter's half that the motor uses: 0 down to -2047.
    static Phases converted(Phases current) {
        constexpr double kSpan = 2047, kInside = 1000;
        const Phases raw = current.nearest() - Phases(kMiddle);
        return current.inside(kInside) ? raw : raw.clamped(-kSpan, 0);
    }
    void turn(std::int32_t by) {
        const std::int32_t angle = angle_ + by;
        const bool at_the_mark = angle_ >= constants_.counts_a_field - kMarkWidth || angle < 0 ||
                                 angle >= constants_.counts_a_field;
        if (at_the_mark) return turn_at_the_mark(by);
        angle_ = angle;
    }
    void turn_at_the_mark(std::int32_t by);
    void pass_mark(bool forwards);
    std::int32_t table_angle(std::int32_t angle) const {
        const std::int32_t whole = constants_.counts_a_field;
        const std::int32_t on_turn = angle >= whole ? angle - whole : angle < 0 ? angle + whole : angle;
        return mac800_ ? on_turn * SineTable::kTurn / kBigField : on_turn;
    }

    const MotorConstants& constants_;
    bool mac800_;
    double per_nominal_;
    double watts_of_one_;
    CurrentRegulator regulator_;
    HallSettings hall_;
    Winding winding_;
    double supply_volts_ = 0;
    std::int64_t counts_ = 0;
    std::int32_t angle_ = 0;  // of the rotor in its field, encoder counts
    std::int32_t shift_ = 0;  // from it to ELDEG_IST
    std::int32_t v_eldeg_ = 0;
    bool every_mark_ = false;
    bool at_mark_ = false;  // has been at the hall elements' mark
};

/// Windings and current loop over one outer sample, in one step: the torque response of the loop with factory
/// coefficients, limited by the supply against the EMF. Currents and voltages in the registers' units.
class QuickLoop {
  public:
    struct Step {
        double squares;  ///< of the three currents, summed
        double watts;    ///< into the windings
    };

    explicit QuickLoop(const MotorConstants& constants);

    /// The previous sample had no torque.
    void rest() { torque_before_ = 0; }

    /// A sample with requested `torque` and `volts` on the bus.
    Step drive(double torque, double volts, Plant& plant) {
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
    /// A sample with shorted windings, which brake with the current from their EMF.
    Step brake(Plant& plant);

  private:
    /// Average response of the current loop to a torque change over the sample: after n inner samples it is 1
    /// - (1 + 0.6 n) 0.4^n, with factory coefficients.
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
