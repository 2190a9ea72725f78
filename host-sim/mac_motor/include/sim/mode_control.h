#pragma once

#include <cstdint>
#include <string_view>

#include "sim/motion_profile.h"
#include "sim/motor_inputs.h"
#include "sim/motor_state.h"
#include "sim/servo.h"

namespace nplc::sim {

/// Mode changes (001 §4.4, §5.2.1.4 command 10h) and the automatic actions of a mode. The properties of a
/// mode, and how it is left, are in the mode table.
class ModeControl {
  public:
    ModeControl(MotorState& state, MotionProfile& profile, const MotorInputs& inputs, const Servo& servo)
        : state_(state), memory_(state.memory), profile_(profile), inputs_(inputs), servo_(servo) {}

    void power_up();

    /// No effect in SAFE_MODE, and for SAFE_MODE: it is entered and left over MacTalk only.
    void request_mode(std::uint16_t mode);
    /// The mode that HOME_MODE names for FastMAC's command.
    void request_home();
    /// 001 §4.1.8, §4.4.1: to INIT in the way that the mode allows.
    void go_passive(bool emergency);
    /// Sets the error with all its consequences.
    void fail(std::uint32_t error);

    /// 001 §4.1.8, §4.4.5, §4.4.9 to §4.4.11: automatic actions of a mode.
    void end_mode_by_itself() {
        if (state_.facts().driven() && !state_.is_mode(MotorMode::stop) && !coasting_) return;
        end_stop_or_test();
    }
    /// A sample of a homing mode.
    void search_home();
    /// The Drive of a mode without speed regulator.
    Drive test_drive() const;

    /// Why the motor is at rest in the requested mode, as a sentence; empty if there is no reason.
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
    std::int32_t brake_direction_ = 0;  // BREAK: sign of the motion to be ended
    std::string_view note_;
};

}  // namespace nplc::sim
