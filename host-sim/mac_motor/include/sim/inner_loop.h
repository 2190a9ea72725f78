#pragma once

#include <cmath>
#include <cstdint>

#include "sim/current_regulator.h"
#include "sim/plant.h"

namespace nplc::sim {

/// Three windings in a star whose middle is open, on a rotor with a sinusoidal field. Currents and voltages
/// in the registers' units, the voltages at the nominal supply; a step is a sample of the inner loop.
class Winding {
  public:
    struct Constants {
        double resistance;  ///< voltage a current
        double decay;       ///< what is left of a current after a step without voltage: exp(-T R / L)
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
    /// counts/step. The torque is that of the currents' mean.
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

/// The current loop at its own rate, with the windings and the rotor that it acts on (001 §1.2, §4.3).
/// A sample is `sense`, one call that sets voltages, then `move`.
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
    /// The sample itself. Answers the watts that went into the windings.
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

    /// What the converters give without a current is the negative of this (ours): what IA_OFFSET ... find.
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
