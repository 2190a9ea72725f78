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
        bool always = false;  ///< HALL_INT: at every mark, not only at the first after power-up
    };

    explicit InnerLoop(registers::Model model);

    void use(const CurrentRegulator::Settings& settings, const HallSettings& hall);
    /// As after power-up: no currents. R: the rotor's angle is known at once.
    void power_up(std::int64_t counts);

    /// Reads currents and encoder.
    void sense(std::int64_t counts);
    void drive_torque(std::int32_t torque);
    void drive_field(std::int32_t i_nom, std::int32_t angle);
    void drive_voltage(const PerPhase<std::int32_t>& voltage) { regulator_.apply(voltage); }
    /// The sample itself. Answers the watts that went into the windings.
    double move(Plant& plant, double supply_volts);

    const CurrentRegulator& regulator() const { return regulator_; }
    void clear_at_the_end() { regulator_.clear_at_the_end(); }
    std::int32_t eldeg() const;                        ///< ELDEG_IST
    std::int32_t v_eldeg() const { return v_eldeg_; }  ///< V_ELDEG
    std::uint32_t hall_bits() const;                   ///< the three hall elements, bit 0 to 2
    PerPhase<std::int32_t> emf() const;                ///< EMK_A ..., voltage units
    double squares() const;                            ///< IA_IST^2 + IB_IST^2 + IC_IST^2
    double regenerated() const;                        ///< Preg of 001 §3.2.18, watts, 0 at the least

    /// What the converters give without a current is the negative of this (ours): what IA_OFFSET ... find.
    static constexpr PerPhase<std::int32_t> kMiddle{1021, 1030, 1017};

  private:
    void turn(std::int32_t by);
    std::int32_t table_angle(std::int32_t angle) const;

    const MotorConstants& constants_;
    bool mac800_;
    CurrentRegulator regulator_;
    HallSettings hall_;
    Winding winding_;
    double supply_volts_ = 0;
    std::int64_t counts_ = 0;
    std::int32_t angle_ = 0;  // of the rotor in its field, encoder counts
    std::int32_t shift_ = 0;  // from it to ELDEG_IST
    std::int32_t v_eldeg_ = 0;
    bool at_mark_ = false;  // has been at the hall elements' mark
};

}  // namespace nplc::sim
