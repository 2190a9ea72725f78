#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <optional>
#include <string_view>

#include "base/time.h"
#include "registers/mac.h"
#include "sim/analogue_input.h"
#include "sim/coil.h"
#include "sim/error_bits.h"
#include "sim/fastmac_slave.h"
#include "sim/gear.h"
#include "sim/homing.h"
#include "sim/mactalk_slave.h"
#include "sim/mode_table.h"
#include "sim/motor_memory.h"
#include "sim/profile.h"
#include "sim/pulse_input.h"
#include "sim/sample_buffer.h"
#include "sim/servo.h"
#include "sim/surroundings.h"
#include "sim/terminals.h"

namespace nplc::sim {

struct MacMotorOptions {
    std::uint8_t address = 1;  ///< MYADDR
    std::int32_t baud = 19200;
    /// The register codes of the example in 001 §5.2.1.5 in place of §5.2.1.4's list.
    bool old_register_codes = false;
    std::size_t order_limit = 100'000;
    /// How much of the motor is computed. `outer_loop` is some ten times as fast, and close in position and
    /// velocity.
    Servo::Depth depth = Servo::Depth::current_loop;
    Load load{};
};

/// A virtual MAC motor with its user interface set to FastMAC/FlexMAC. It has no clock: the caller gives it
/// bytes with their times, fetches bytes when the line is free, and calls `sample` once every
/// `sample_period`. Deterministic: the same calls give the same motion on every machine.
class MacMotor final : private LinkTarget, private MacTalkTarget, private InnerWatcher {
  public:
    explicit MacMotor(registers::Model model, const MacMotorOptions& options = {});

    registers::Model model() const { return memory_.model(); }
    std::int32_t counts_per_revolution() const;
    /// Of the outer loop: exactly 15 / 7812.5 Hz on MAC50-141, 1 / 770 Hz (to the nanosecond) on MAC800.
    std::chrono::nanoseconds sample_period() const;

    /// One outer sample: shaft, encoder, profile, regulator, flags, monitoring (001 §4).
    [[gnu::flatten]] void sample();

    /// The user interface, see FastMacSlave. Dead if CNTRL_BITS chose another use of the pins at power-up.
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
    /// As a line writes it, with all effects: MODE_REG asks for a mode, P_REG_P ... Z_REG_P act.
    void write(std::uint8_t reg, std::int32_t value, bool longword);
    /// The same by the register's own width.
    void write(std::uint8_t reg, std::int32_t value);

    /// MODE_REG
    std::uint16_t mode() const { return static_cast<std::uint16_t>(memory_.get(cell::MODE_REG)); }
    bool is_mode(MotorMode mode) const { return this->mode() == number(mode); }
    std::int32_t p_ist() const { return memory_.get(cell::P_IST); }
    std::int32_t v_ist() const { return memory_.get(cell::V_IST); }
    std::int32_t torque() const { return memory_.get(cell::VF_OUT); }
    double rpm() const;
    bool in_position() const { return (error_status() & err::IN_POS) != 0; }
    std::uint32_t err_stat() const { return error_status(); }

    /// Why the motor stands in the mode that it was asked for, as a sentence: a gear mode without the pins of
    /// the pulse input, or TESTTQ, of which the manual says nothing. Empty if all is well.
    std::string_view note() const { return note_; }
    /// As if I2T had been above its limit for a moment: I2T_ERR and all that follows from it.
    void overload() { fail(err::I2T_ERR); }
    /// The output for a holding brake (004, MAN_NO_BRAKE): on while the motor is passive. A brake that
    /// is built in (Load::brake_torque) then holds the shaft.
    bool brake_output() const;

    /// 001 §4.4.16: only over MacTalk, so not over the user interface. False: refused (not in INIT, not in
    /// SAFE).
    bool enter_safe_mode() override;
    bool leave_safe_mode();
    /// Out of SAFE at once, out of any other mode through STOP (001 §5.1, message 55h).
    void go_to_init() override;
    /// Keeps the present registers and resets; false and nothing done outside of SAFE (001 §5.1, message
    /// 56h).
    bool write_flash() override;
    /// As after power-up; false and nothing done unless in INIT or SAFE (message 57h).
    bool reset() override;

    /// Keeps the present registers over `power_cycle`, as a write to flash does: parameters, not what the
    /// motor counts and shows.
    void store_registers();
    /// The parameter flash, for whoever keeps it over the program's end.
    const MotorMemory& stored() const { return stored_; }
    void set_stored(const MotorMemory& stored) { stored_ = stored; }
    /// How often the motor has written its flash since it was built.
    std::uint32_t flash_writes() const { return flash_writes_; }
    /// Off and on: stored registers, P_IST and P_FNC 0, toggle 0, STARTMODE. The shaft stays where it is.
    void power_cycle();

    /// Load and mechanical stops, changeable in motion.
    Plant& plant() { return servo_.plant(); }
    const Plant& plant() const { return servo_.plant(); }
    /// Changeable at any time; U_SUPPLY (MAC800: U_BUS) follows.
    Supply& supply() { return servo_.supply(); }
    /// What is wired to the analogue and the pulse input, changeable at any time.
    Terminals& terminals() { return terminals_; }
    Surroundings& surroundings() { return surroundings_; }

  private:
    void set_up_user_interface();
    std::uint16_t first_mode() const;

    // LinkTarget, and what FastMAC commands do: motor_commands.cpp
    void execute(const protocol::fastmac::Command& command) override;
    std::uint32_t read_register(std::uint8_t reg, bool longword) const override;
    void write_register(std::uint8_t reg, std::uint32_t value, bool longword) override;
    std::uint32_t error_status() const override {
        return static_cast<std::uint32_t>(memory_.get(cell::ERR_STAT));
    }
    void show_framing_error(bool seen) override;
    bool in_safe_mode() const override { return is_mode(MotorMode::safe); }
    std::uint8_t my_address() const override;
    void execute_number(protocol::fastmac::Number number);
    void select(protocol::fastmac::Group group, int index);
    void select_position(int index);
    void select_set(int index);
    void act_on_pointers();
    void copy(Cell from, Cell to) { memory_.set(to, memory_.get(from)); }
    void set_relative(bool p_soll, bool p_fnc);
    void clear_in_position() {
        samples_within_ = 0;
        set_error_bits(err::IN_POS, false);
    }

    // MacTalk's own: motor_service.cpp
    static void clear_volatile(MotorMemory& memory);
    void load_parameters(std::uint16_t command);
    void run_sample_buffer() {
        const auto control = static_cast<std::uint32_t>(memory_.get(cell::CNTRL_BITS));
        if ((control & (bits().rewind | bits().record)) != 0) rewind_or_record(control);
    }
    void rewind_or_record(std::uint32_t control);
    bool records_inner(std::uint32_t control) const;
    void rewind_samples();
    void record();
    void inner_sample() override;
    SampleBuffer::Sample sampled_registers() const;
    SampleBuffer::Sample next_sample() override;

    // Modes and monitoring: motor_modes.cpp
    void request_mode(std::uint16_t mode);
    void request_home();
    void request_init();
    void enter(std::uint16_t mode);
    void set_mode(std::uint16_t mode) {
        memory_.set(cell::MODE_REG, mode);
        facts_ = facts_of(mode);
    }
    void leave_for(std::uint16_t mode);
    void go_passive(bool emergency);
    void begin_stop(std::uint16_t then, bool emergency);
    void begin_at_measured_speed();
    /// 001 §4.1.8, §4.4.5, §4.4.9 to §4.4.11: what a mode does without being asked.
    void end_mode_by_itself() {
        if (is_driven() && !is_mode(MotorMode::stop) && !coasting_) return;
        end_stop_or_test();
    }
    void end_stop_or_test();
    bool error_keeps_mode() const;
    const ModeFacts& facts() const { return *facts_; }
    bool is_driven() const { return facts().driven(); }
    bool below_300_rpm() const;
    void begin_correction();
    std::string_view why_it_stands(std::uint16_t mode) const;

    // Monitoring: monitoring.cpp
    [[gnu::flatten]] void monitor();
    void fail(std::uint32_t error);
    void watch_limits();
    void watch_supply();
    void watch_currents();
    void watch_mac800();
    /// A limit of 0 is none (001 §4.5.4, §4.5.5).
    bool exceeds(Cell value, Cell limit) const {
        const std::int64_t most = memory_.get(limit);
        return most > 0 && std::abs(std::int64_t{memory_.get(value)}) > most;
    }
    bool is_above(Cell value, Cell limit) const { return memory_.get(value) > memory_.get(limit); }

    // MANI, TESTU, TESTA, BREAK, TESTKI: mode_test.cpp
    void begin_test();
    Drive test_drive() const;
    void set_recording(bool on);
    void end_test();
    bool is_braked() const;

    // Homing: motor_homing.cpp
    void begin_homing();
    void search_home();
    void end_homing();
    std::int32_t beyond_index() const;
    void set_home_done(bool done);

    // One sample: mac_motor.cpp
    void measure();
    void show_v_ist_16(std::int32_t v_ist);
    void read_inputs();
    void resynchronise();
    bool resynchronises_by_itself() const;
    void stay_passive();

    // Profile and regulator: motor_profile.cpp
    [[gnu::flatten]] void run_profile();
    void run_position();
    void run_gear();
    void run_coil();
    Coil::Setup coil_setup() const;
    void show_gear_error();
    std::int32_t analogue_v_soll() const;
    /// P_SOLL or P_FNC of the position block, where the voltage sets them.
    void set_target_by_voltage() {
        if (is_mode(MotorMode::analogue_two_positions)) set_target_by_level();
        if (is_mode(MotorMode::analogue_position)) set_target_by_place();
    }
    void set_target_by_place();
    void set_target_by_level();
    void run_to(std::int64_t distance);
    std::int32_t braking(std::int64_t distance, std::int32_t acceleration);
    void go_on_from(std::int32_t fnc_out, bool thrown_back);
    void learn_braking(std::int32_t wanted, std::int32_t correction);
    void regulate(std::int32_t fnc_out);
    void show_profile(std::int32_t fnc_out);
    [[gnu::flatten]] void judge_in_position();
    bool within_window() const;
    std::int64_t distance_16() const;
    std::int32_t acceleration() const;
    std::int32_t torque_limit() const;
    std::int32_t v_soll() const;
    void set_error_bits(std::uint32_t mask, bool on) { show_error_bits(mask, on ? mask : 0); }
    /// Those of `mask` become those of `on`.
    void show_error_bits(std::uint32_t mask, std::uint32_t on) {
        const std::uint32_t status = error_status();
        const std::uint32_t wanted = (status & ~mask) | on;
        if (wanted != status) memory_.set(cell::ERR_STAT, static_cast<std::int32_t>(wanted));
    }
    const FamilyBits& bits() const { return *bits_; }

    MacMotorOptions options_;
    MotorMemory memory_;
    MotorMemory stored_;
    const FamilyBits* bits_;
    const ModeFacts* facts_ = facts_of(0);  // of MODE_REG
    Servo servo_;
    Terminals terminals_;
    Surroundings surroundings_;
    PulseInput pulse_input_;
    AnalogueVoltage analogue_voltage_;
    AnalogueLevel analogue_level_;
    bool analogue_was_on_ = false;  // in the sample before
    Gear gear_;
    Coil coil_;
    Homing homing_;
    FastMacSlave link_;
    MacTalkSlave mactalk_;
    SampleBuffer samples_;

    std::uint32_t flash_writes_ = 0;
    bool link_on_ = true;
    std::int32_t v_old_ = 0;              // V_OLD, 1/16 counts/sample
    std::int32_t v_from_ = 0;             // what the next profile begins with: V_OLD, 0 if it was thrown back
    std::int64_t follow_error_16_ = 0;    // FLWERR, 1/16 counts
    std::int32_t corrected_braking_ = 0;  // what brakes in torque limit, 1/16 counts/sample^2; 0: A_SOLL does
    std::int64_t distance_to_go_ = 0;     // as the last sample of position mode left it, 1/16 counts
    std::int32_t samples_within_ = 0;
    std::uint16_t mode_after_stop_ = 0;
    bool emergency_ = false;
    bool coasting_ = false;             // AT on its way to INIT
    int test_samples_ = 0;              // of TESTU and TESTA
    std::int32_t brake_direction_ = 0;  // BREAK: the sign of the motion that it ends
    std::int32_t uv_timer_ = 0;         // UV_TIMER, samples
    std::array<std::int32_t, 16> v_history_{};
    std::size_t v_next_ = 0;
    std::int32_t v_sum_ = 0;
    std::string_view note_;
};

}  // namespace nplc::sim
