#pragma once

#include <cstdint>

#include "sim/current_regulator.h"
#include "sim/motor_constants.h"
#include "sim/plant.h"
#include "sim/winding.h"

namespace nplc::sim {

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

}  // namespace nplc::sim
