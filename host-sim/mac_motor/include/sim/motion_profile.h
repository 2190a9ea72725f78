#pragma once

#include <cstdint>
#include <cstdlib>

#include "sim/motor_inputs.h"
#include "sim/motor_state.h"
#include "sim/profile_blocks.h"
#include "sim/servo.h"

namespace nplc::sim {

/// The motion profile of each sample from registers and inputs: the velocity for the servo, P_FNC, the follow
/// error and IN_POS (001 §4.1, §4.4.2 to §4.4.4).
class MotionProfile {
  public:
    MotionProfile(MotorState& state, const MotorInputs& inputs, Servo& servo)
        : state_(state), memory_(state.memory), inputs_(inputs), servo_(servo) {}

    void power_up();

    /// MAN_RESYNC and AUTO_RESYNC (001 §3.2.163).
    void resynchronise();
    /// One sample in a mode with speed regulator.
    [[gnu::flatten]] void run();
    [[gnu::flatten]] void judge_in_position();
    /// One sample in a mode without.
    void stay_passive(const Drive& drive);

    /// Entry of a mode other than the present one.
    void begin_mode(const ModeFacts& next);
    void begin_stop() { v_from_ = v_old_; }
    /// After a mode without speed regulator: the profile begins with the shaft's position and speed.
    void begin_at_measured_speed();

    void begin_homing(Homing::Method method);
    /// One sample in a homing mode. True: this is the zero.
    bool search_home();
    /// Sets the shaft's position to `position` and restarts the profile from there.
    void take_position(std::int32_t position);

    /// P register `index` becomes the target, as selected over FastMAC.
    void select_position(int index);
    void clear_in_position() {
        samples_within_ = 0;
        state_.set_error_bits(err::IN_POS, false);
    }
    /// FLWERR was written over a line.
    void take_follow_error() { follow_error_16_ = 16 * std::int64_t{memory_.get(cell::FLWERR)}; }

  private:
    bool resynchronises_by_itself() const;
    void run_position();
    void run_gear();
    void run_coil();
    Coil::Setup coil_setup() const;
    void show_gear_error();
    std::int32_t analogue_v_soll() const;
    /// Sets P_SOLL or P_FNC of the position block from the analogue voltage.
    void set_target_by_voltage() {
        if (state_.is_mode(MotorMode::analogue_two_positions)) set_target_by_level();
        if (state_.is_mode(MotorMode::analogue_position)) set_target_by_place();
    }
    void set_target_by_place();
    void set_target_by_level();
    void run_to(std::int64_t distance);
    std::int32_t braking(std::int64_t distance, std::int32_t acceleration);
    void go_on_from(std::int32_t fnc_out, bool thrown_back);
    void learn_braking(std::int32_t wanted, std::int32_t correction);
    void begin_correction();
    void regulate(std::int32_t fnc_out);
    void show_profile(std::int32_t fnc_out);
    bool within_window() const;
    std::int64_t distance_16() const;
    std::int32_t acceleration() const;
    std::int32_t torque_limit() const;
    std::int32_t v_soll() const;

    MotorState& state_;
    MotorMemory& memory_;
    const MotorInputs& inputs_;
    Servo& servo_;
    Gear gear_;
    Coil coil_;
    Homing homing_;
    std::int32_t v_old_ = 0;  // V_OLD, 1/16 counts/sample
    std::int32_t v_from_ =
        0;  // initial velocity of the next profile: V_OLD, 0 after a reversal by the torque limit
    std::int64_t follow_error_16_ = 0;  // FLWERR, 1/16 counts
    std::int32_t corrected_braking_ =
        0;  // effective braking in torque limit, 1/16 counts/sample^2; 0: A_SOLL applies
    std::int64_t distance_to_go_ = 0;  // at the end of the last sample in position mode, 1/16 counts
    std::int32_t samples_within_ = 0;  // INPOSWIN
};

}  // namespace nplc::sim
