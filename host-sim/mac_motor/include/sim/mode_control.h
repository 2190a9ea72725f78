#pragma once

#include <cstdint>
#include <string_view>

#include "sim/motion_profile.h"
#include "sim/motor_inputs.h"
#include "sim/motor_state.h"
#include "sim/servo.h"

namespace nplc::sim {

/// Switching of modes (001 §4.4, §5.2.1.4 command 10h) and what a mode does without being asked. What a mode
/// is, and how it is left, is in the mode table.
class ModeControl {
  public:
    ModeControl(MotorState& state, MotionProfile& profile, const MotorInputs& inputs, const Servo& servo)
        : state_(state), memory_(state.memory), profile_(profile), inputs_(inputs), servo_(servo) {}

    void power_up();

    /// Nothing in SAFE_MODE, and for SAFE_MODE: its doors are MacTalk's.
    void request_mode(std::uint16_t mode);
    /// The mode that HOME_MODE names for FastMAC's command.
    void request_home();
    /// 001 §4.1.8, §4.4.1: to INIT as the mode allows it.
    void go_passive(bool emergency);
    /// Shows the error and all that follows from it.
    void fail(std::uint32_t error);

    /// 001 §4.1.8, §4.4.5, §4.4.9 to §4.4.11: what a mode does without being asked.
    void end_mode_by_itself() {
        if (state_.facts().driven() && !state_.is_mode(MotorMode::stop) && !coasting_) return;
        end_stop_or_test();
    }
    /// A sample of a homing mode.
    void search_home();
    /// What a mode without speed regulator asks of the servo.
    Drive test_drive() const;

    /// Why the motor stands in the mode that it was asked for, as a sentence; empty if all is well.
    std::string_view note() const { return note_; }

  private:
    void request_init();
    void enter(std::uint16_t mode);
    void leave_for(std::uint16_t mode);
    void begin_stop(std::uint16_t then, bool emergency);
    void end_stop_or_test();
    bool error_keeps_mode() const;
    bool below_300_rpm() const;
    std::string_view why_it_stands(std::uint16_t mode) const;

    // MANI, TESTU, TESTA, BREAK, TESTKI
    void begin_test();
    void set_recording(bool on);
    void end_test();
    bool is_braked() const;

    void begin_homing();
    void end_homing();
    std::int32_t beyond_index() const;
    void set_home_done(bool done);

    MotorState& state_;
    MotorMemory& memory_;
    MotionProfile& profile_;
    const MotorInputs& inputs_;
    const Servo& servo_;
    std::uint16_t mode_after_stop_ = 0;
    bool coasting_ = false;             // AT on its way to INIT
    int test_samples_ = 0;              // of TESTU and TESTA
    std::int32_t brake_direction_ = 0;  // BREAK: the sign of the motion that it ends
    std::string_view note_;
};

}  // namespace nplc::sim
