#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <string_view>

#include "base/time.h"
#include "registers/mac.h"
#include "sim/fastmac_slave.h"
#include "sim/mactalk_slave.h"
#include "sim/mode_control.h"
#include "sim/motion_profile.h"
#include "sim/motor_commands.h"
#include "sim/motor_inputs.h"
#include "sim/motor_monitor.h"
#include "sim/motor_state.h"
#include "sim/sample_recorder.h"
#include "sim/servo.h"

namespace nplc::sim {

struct MacMotorOptions {
    std::uint8_t address = 1;  ///< MYADDR
    std::int32_t baud = 19200;
    /// The register codes of the example in 001 §5.2.1.5 in place of §5.2.1.4's list.
    bool old_register_codes = false;
    std::size_t order_limit = 100'000;
    /// Depth of the motor's computation. `outer_loop` is some ten times as fast, and close in position and
    /// velocity.
    Servo::Depth depth = Servo::Depth::current_loop;
    Load load{};
};

/// A virtual MAC motor with its user interface set to FastMAC/FlexMAC. It has no clock: the caller passes
/// bytes with their times, polls bytes when the line is free, and calls `sample` once every `sample_period`.
/// Deterministic: the same calls give the same motion on every machine.
class MacMotor final : private LinkTarget, private MacTalkTarget {
  public:
    explicit MacMotor(registers::Model model, const MacMotorOptions& options = {});

    registers::Model model() const { return state_.model(); }
    std::int32_t counts_per_revolution() const { return state_.counts_per_revolution(); }
    /// Of the outer loop: exactly 15 / 7812.5 Hz on MAC50-141, 1 / 770 Hz (to the nanosecond) on MAC800.
    std::chrono::nanoseconds sample_period() const { return state_.sample_period(); }

    /// One outer sample: shaft, encoder, profile, regulator, flags, monitoring (001 §4).
    [[gnu::flatten]] void sample();

    /// The same without supply: the shaft coasts or follows its load; V_IST shows it, and P_IST does not
    /// count it. A holding brake holds.
    void coast();

    /// The user interface, see FastMacSlave. Inactive if CNTRL_BITS selected another use of the pins at
    /// power-up.
    void receive(std::uint8_t byte, bool framing_error, base::Instant now);
    std::optional<std::uint8_t> transmit(base::Instant now);
    const FastMacSlave& link() const { return link_; }

    /// The MacTalk line, see MacTalkSlave; works whatever the user interface is set to.
    void receive_mactalk(std::uint8_t byte, bool framing_error);
    std::optional<std::uint8_t> transmit_mactalk();

    /// FastMAC commands and FlexMAC writes in the order in which they were accepted.
    const std::deque<Order>& orders() const { return link_.orders(); }
    std::deque<Order> take_orders() { return link_.take_orders(); }

    /// A register by its own width and sign; unknown ones as unsigned words (MAC800: longwords).
    std::int32_t read(std::uint8_t reg) const;
    /// As a write over a line, with all effects: MODE_REG requests a mode, P_REG_P ... Z_REG_P act.
    void write(std::uint8_t reg, std::int32_t value, bool longword);
    /// The same by the register's own width.
    void write(std::uint8_t reg, std::int32_t value);

    /// MODE_REG
    std::uint16_t mode() const { return state_.mode(); }
    bool is_mode(MotorMode mode) const { return state_.is_mode(mode); }
    std::int32_t p_ist() const { return state_.p_ist(); }
    std::int32_t v_ist() const { return state_.v_ist(); }
    std::int32_t torque() const { return state_.memory.get(cell::VF_OUT); }
    double rpm() const;
    bool in_position() const { return (error_status() & err::IN_POS) != 0; }
    std::uint32_t err_stat() const { return error_status(); }

    /// Why the motor is at rest in the requested mode, as a sentence: a gear mode without the pins of the
    /// pulse input, or TESTTQ, which the manual does not describe. Empty if there is no reason.
    std::string_view note() const { return modes_.note(); }
    /// As if I2T had exceeded its limit for a moment: I2T_ERR with all its consequences.
    void overload() { modes_.fail(err::I2T_ERR); }
    /// The output for a holding brake (004, MAN_NO_BRAKE): on while the motor is passive. A brake that
    /// is built in (Load::brake_torque) then holds the shaft.
    bool brake_output() const;

    /// 001 §4.4.16: only over MacTalk, so not over the user interface. False: refused (not in INIT, not in
    /// SAFE).
    bool enter_safe_mode() override;
    bool leave_safe_mode();
    /// Out of SAFE at once, out of any other mode through STOP (001 §5.1, message 55h).
    void go_to_init() override;
    /// Stores the present registers and resets; false, without effect, outside of SAFE (001 §5.1, message
    /// 56h).
    bool write_flash() override;
    /// As after power-up; false, without effect, unless in INIT or SAFE (message 57h).
    bool reset() override;

    /// Keeps the present registers over `power_cycle`, as a write to flash does: the parameters, not the
    /// values that the motor counts and shows.
    void store_registers();
    /// The parameter flash, for storing it beyond the program's end.
    const MotorMemory& stored() const { return stored_; }
    void set_stored(const MotorMemory& stored) { stored_ = stored; }
    /// Number of flash writes since construction.
    std::uint32_t flash_writes() const { return flash_writes_; }
    /// Off and on: stored registers, P_IST and P_FNC 0, toggle 0, STARTMODE. The shaft does not move.
    void power_cycle();

    /// Load and mechanical stops, changeable in motion.
    Plant& plant() { return servo_.plant(); }
    const Plant& plant() const { return servo_.plant(); }
    /// Changeable at any time; U_SUPPLY (MAC800: U_BUS) follows.
    Supply& supply() { return servo_.supply(); }
    /// Signals at the analogue and the pulse input, changeable at any time.
    Terminals& terminals() { return inputs_.terminals; }
    Surroundings& surroundings() { return inputs_.surroundings; }

  private:
    // LinkTarget and MacTalkTarget
    void execute(const protocol::fastmac::Command& command) override { commands_.execute(command); }
    std::uint32_t read_register(std::uint8_t reg, bool longword) const override;
    void write_register(std::uint8_t reg, std::uint32_t value, bool longword) override;
    std::uint32_t error_status() const override { return state_.error_status(); }
    void show_framing_error(bool seen) override;
    bool in_safe_mode() const override { return is_mode(MotorMode::safe); }
    std::uint8_t my_address() const override;
    SampleBuffer::Sample next_sample() override { return recorder_.next(); }

    void measure();
    void show_v_ist_16(std::int32_t v_ist);
    bool has_user_interface() const;
    std::uint16_t first_mode() const;
    void load_parameters(std::uint16_t command);

    MacMotorOptions options_;
    MotorState state_;
    MotorMemory stored_;
    Servo servo_;
    MotorInputs inputs_;
    MotionProfile profile_;
    ModeControl modes_;
    MotorMonitor monitor_;
    MotorCommands commands_;
    SampleRecorder recorder_;
    FastMacSlave link_;
    MacTalkSlave mactalk_;

    std::uint32_t flash_writes_ = 0;
    bool link_on_ = true;
    std::array<std::int32_t, 16> v_history_{};  // of V_IST, for V_IST_16
    std::size_t v_next_ = 0;
    std::int32_t v_sum_ = 0;
};

}  // namespace nplc::sim
