#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "registers/mac.h"
#include "sim/bounds.h"

namespace nplc::sim {

/// A mechanical end of travel.
struct MechanicalStop {
    std::int64_t counts = 0;  ///< start position, encoder counts from the shaft's initial position
    /// Restoring torque per count of penetration, x 1024; 0: rigid, all motion ends there. A spring also
    /// absorbs the motion: it pushes back without rebound.
    std::int64_t spring_1024 = 0;
};

/// The load of the motor's shaft. Torques as in T_SOLL: 1023 is the motor's full torque.
struct Load {
    static constexpr std::int32_t kLatest = 90;

    double inertia_256 = 256;       ///< total inertia over the motor's own, x 256 (KVOUT's meaning)
    double friction_torque = 5;     ///< Coulomb friction
    std::int32_t brake_torque = 0;  ///< of a holding brake (MAC800's output); 0: none is built in
    double torque = 0;              ///< constant load torque, positive turns the shaft forward
    double viscous_torque = 0;      ///< additional friction per count/sample of the outer loop
    std::int32_t late_inner_samples =
        0;  ///< by which torque comes later than the current loop gives it, to kLatest
    std::optional<MechanicalStop> low_stop{};   ///< the shaft cannot go below it
    std::optional<MechanicalStop> high_stop{};  ///< the shaft cannot go above it
};

/// Shaft, load and encoder, one step at a time: an outer sample, or a part of one. Only +, -, * and / on
/// doubles, so the result is the same on every machine.
class Plant {
  public:
    /// `full_acceleration`: of the bare motor at full torque, counts/sample^2 of the outer loop; `steps`: per
    /// outer sample; `elsewhere`: the part of the bare motor's inertia that the current loop already models.
    Plant(double full_acceleration, int steps, const Load& load, double elsewhere = 0);

    /// To be called before the steps of a sample: applies the present load.
    void take_load() {
        if (taken_) return;
        taken_ = true;
        const double friction = std::max(load_.friction_torque + holding_, 0.0);
        of_one_ = acceleration_of_one_ * 256 / std::max(load_.inertia_256 - elsewhere_256_, 1.0);
        friction_ = friction * of_one_;
        sticking_ = friction == 0 ? 0 : (friction + kStick) * of_one_;
        pull_ = load_.torque;
        drag_ = std::max(load_.viscous_torque, 0.0) * steps_ * of_one_;
        has_stops_ = load_.low_stop || load_.high_stop;
    }
    /// One step with the motor's `torque`.
    void step(double torque) { move(velocity_ + push(torque)); }
    /// The same with `brake` torque per count/step of velocity.
    void step(double torque, double brake) { move((velocity_ + push(torque)) / (1 + brake * of_one_)); }

    /// Encoder counts since construction.
    std::int64_t counts() const { return (position_ + kCount / 2) >> kFractionBits; }
    /// The same with its fraction.
    double position() const { return static_cast<double>(position_) / kCount; }
    /// Applies or releases the holding brake: additional friction.
    void hold(bool on) {
        const std::int32_t holding = on ? std::clamp(load_.brake_torque, 0, kStrongestBrake) : 0;
        if (holding == holding_) return;
        holding_ = holding;
        taken_ = false;
    }
    /// Counts a step.
    double velocity() const { return velocity_; }

    /// May be changed at any time through this reference. A rigid stop that the shaft is beyond moves it
    /// back.
    Load& load() {
        taken_ = false;
        return load_;
    }
    const Load& load() const { return load_; }

  private:
    static constexpr int kFractionBits = 20;
    static constexpr std::int64_t kCount = std::int64_t{1} << kFractionBits;
    static constexpr double kTorqueBound = 1'000'000;
    static constexpr std::int32_t kStrongestBrake = 1'000'000;
    /// Stiction at low speed: a small additional friction, less than the unit of torque. Torques are whole
    /// numbers, so a torque often equals the friction, and without stiction the shaft would creep forever.
    static constexpr double kStick = 0.75;
    static constexpr double kSlow = 0.375;  // counts an outer sample

    /// Friction opposes motion, stops a shaft that is slower than its effect in one step, and never reverses
    /// it.
    static double rubbed(double velocity, double friction) {
        if (velocity > friction) return velocity - friction;
        if (velocity < -friction) return velocity + friction;
        return 0;
    }
    double push(double torque) const { return within(torque + pull_, kTorqueBound) * of_one_; }
    /// Moves with the velocity that would result without friction.
    void move(double pushed) {
        const double before = velocity_;
        if (drag_ != 0) pushed /= 1 + drag_;
        const double friction = before > -slow_ && before < slow_ ? sticking_ : friction_;
        velocity_ = within(rubbed(pushed, friction), fastest_);
        const std::int64_t from = position_;
        position_ += static_cast<std::int64_t>((before + velocity_) * (kCount / 2));
        if (has_stops_) keep_within_stops(from);
    }
    void keep_within_stops(std::int64_t from);
    const MechanicalStop* stop_beyond() const;
    void press(const MechanicalStop& stop, std::int64_t from);

    double acceleration_of_one_;  // of torque 1 on the bare motor, counts/step^2
    double elsewhere_256_;
    int steps_;
    double fastest_;
    double slow_;    // below it the shaft sticks, counts/step
    double thrown_;  // factor per step of the velocity with which a spring pushes back
    Load load_;
    std::int32_t holding_ = 0;  // of the brake
    bool taken_ = false;        // what follows is of load_ and holding_
    double of_one_ = 0;         // of torque 1 on motor and load, counts/step^2
    double friction_ = 0;       // valid for the present load_ and holding_
    double sticking_ = 0;       // the same where the shaft is slow
    double pull_ = 0;           // torque
    double drag_ = 0;           // of a velocity, what viscous friction takes in a step
    bool has_stops_ = false;
    std::int64_t position_ = 0;  // 1/kCount counts
    double velocity_ = 0;        // counts/step
};

/// The motor's power supply: a source that does not take energy back, the capacitor of the bus, and the power
/// dump that turns energy returned by the shaft into heat (001 §3.2.18, §4.5.2).
class Supply {
  public:
    struct Constants {
        double source_volts;  ///< without load
        double dump_volts;    ///< above it the dump is on: 52 V on MAC50-141 (001 §3.2.18)
        double source_ohms;
        double dump_ohms;
        double farads;
    };
    static constexpr double kLeast = 1;  // V, prevents a division by 0
    static constexpr double kMost = 1000;
    static constexpr double kBleedSeconds = 0.5;  ///< time constant with which the bus falls to its source
    static constexpr double kHold = 1.004;        ///< times dump_volts: what the dump keeps the bus at

    /// `seconds`: of a step.
    Supply(const Constants& constants, double seconds)
        : constants_(constants),
          volts_of_ampere_(seconds / constants.farads),
          charged_(volts_of_ampere_ / (volts_of_ampere_ + constants.source_ohms)),
          bled_(seconds / (seconds + kBleedSeconds)),
          dumped_(volts_of_ampere_ / (volts_of_ampere_ + constants.dump_ohms)),
          held_(constants.dump_volts * kHold),
          volts_(constants.source_volts) {}

    /// What the source gives without load; may be changed at any time.
    void set_source(double volts) { constants_.source_volts = std::clamp(volts, 0.0, kMost); }
    double source() const { return constants_.source_volts; }

    double volts() const { return volts_; }
    bool dumping() const { return volts_ > constants_.dump_volts; }

    /// `watts` go to the windings for a step; negative: they come back. Source and dump are integrated
    /// implicitly, which is stable for any step.
    void step(double watts) {
        double volts = volts_ - watts / volts_ * volts_of_ampere_;
        if (volts > held_) volts = std::max(volts - volts * dumped_, held_);
        if (volts > constants_.source_volts) volts = std::max(volts - volts * bled_, constants_.source_volts);
        if (volts < constants_.source_volts) volts += (constants_.source_volts - volts) * charged_;
        volts_ = within(volts, kLeast, kMost);
    }
    /// The bus of a source that was switched off and on, or one that has had time.
    void settle() { volts_ = std::max(constants_.source_volts, kLeast); }

  private:
    Constants constants_;
    double volts_of_ampere_;
    double charged_;  // of what is missing, in a step
    double bled_;
    double dumped_;
    double held_;  // what the dump keeps the bus at
    double volts_;
};

/// Electrical and magnetic constants of a family, chosen by this project; the folder's README says how.
/// MAC50, 95, 140 and 141 share one set.
struct MotorConstants {
    double outer_period;       ///< s
    double full_acceleration;  ///< of the bare motor at full torque, counts/sample^2 of the outer loop
    double emf_inertia;        ///< of the motor, as seen with the rising EMF and the current loop of the box
    std::int32_t counts_a_field;  ///< encoder counts in a turn of the field
    double full_current;          ///< peak phase current at full torque, register units
    double resistance;            ///< voltage units a current unit
    double decay;                 ///< of a current in a sample of the inner loop
    double emf;                   ///< voltage units a count of the inner loop
    double volts_of_one;          ///< V a voltage unit at the nominal supply
    double amperes_of_one;        ///< A a current unit
    double nominal_volts;         ///< of the supply
    double volts_register;        ///< U_SUPPLY or U_BUS, units a volt
    Supply::Constants supply;
    double dump_watts;      ///< that the dump bears for ever: UIT becomes 10000
    double dump_seconds;    ///< its time constant
    double copper_seconds;  ///< time constant of I2T; 10000 at a third of full torque
    double warming;         ///< degrees above the air at I2T = 10000 (MAC800)
};

/// Samples of the inner loop in one of the outer (001 §1.2; R: on MAC800 too).
inline constexpr int kInnerSamples = 15;

const MotorConstants& constants_of(registers::Model model);

}  // namespace nplc::sim
