#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "motor/access_slot.h"
#include "motor/midi_drive.h"
#include "motor/midi_link.h"
#include "motor/midi_motion.h"
#include "motor/midi_registers.h"
#include "motor/midi_session.h"
#include "motor/motor.h"
#include "motor/order_queue.h"
#include "registers/midi_motor.h"
#include "registers/vocabulary.h"

namespace nplc::motor {

/// Reason of a MidiMotor's ERROR, for the operator. A trip is detailed by MidiMotor::drive_status(), an order
/// that no drive can do by limitation().
using MidiFault = registers::gateway::DriveFault;

/// Text of the fault with the remedy, without a full stop.
std::string_view text_of(MidiFault fault);

/// A MAC23 or MAC34 of MIDI Ingenierie on one of its lines. Keeps the registers that a sequence uses on a JVL
/// motor, and brings the drive to the state in them. The rules and the whole translation: MIDI.md in this
/// folder.
class MidiMotor final : public Motor {
  public:
    using Model = registers::midi::Model;
    struct Settings {
        Model model = Model::mac34_1;
    };

    MidiMotor(MidiLink& link, const Settings& settings) : link_(link), drive_(settings.model) {}

    void poll(base::Instant now) override;
    void begin_orders(base::Instant now) override { work(now); }
    /// Latest time of the next poll, to be asked after each poll() and each call that gives the driver work;
    /// `now` or earlier: at once.
    base::Instant next_poll(base::Instant now) const;
    bool orders_complete() const override;
    bool can_execute(const Order& order) const override { return limitation_of(order) == Limitation::none; }
    bool has_room() const override { return !orders_.full(); }
    void send(const Order& order) override { orders_.push(order, session_.is_up()); }
    void stop() override;
    bool stop_confirmed() const override { return !stop_wanted_; }
    void give_up_stop() override {
        stop_wanted_ = stop_hard_ = false;
        retry_at_ = {};
    }
    bool begin_access(const Access& access) override { return session_.is_up() && access_.begin(access); }
    AccessState access_state() const override { return access_.state(); }
    std::uint32_t access_value() const override { return access_.value(); }
    void drop_access() override { access_.drop(); }
    bool in_position() const override;
    bool error() const override;
    std::uint8_t fault_number() const override { return static_cast<std::uint8_t>(fault_); }
    Link link() const override { return session_.link(); }
    Counters counters() const override;
    bool longwords_only() const override { return false; }

    using Limitation = registers::midi::Limitation;
    Limitation limitation_of(const Order& order) const;

    /// The first reason of the present ERROR; cleared by "reset error" (01h).
    MidiFault fault() const;
    Limitation limitation() const { return limitation_; }           ///< of a `bad_value`
    std::uint32_t drive_status() const { return drive_.status(); }  ///< GET_STATUS, as last received
    const MidiDrive& drive() const { return drive_; }
    bool is_at_target() const { return registers_.mode() == 2 && in_position(); }
    /// The mode is a motion mode and V_SOLL is 0, which blocks every move.
    bool has_no_speed() const {
        return registers_.mode() != 0 && registers_.is_set(registers::V_SOLL) && registers_.v_soll() == 0;
    }
    /// The outcome of the last message while the link was down.
    const MidiOutcome& probe() const { return probe_; }

  private:
    // Outcomes of messages.
    void lose_link(MidiFault why, base::Instant now);
    void look_for_trouble(base::Instant now);
    void on_outcome(const MidiOutcome& outcome, base::Instant now);
    void on_accepted(base::Instant now);
    void on_value(std::uint32_t value, base::Instant now);
    void on_status();
    void on_position(base::Instant now);
    void on_motion(MidiMotion::Event event);
    void on_unclear(base::Instant now);
    void on_refused(base::Instant now);
    void on_refused_motion(base::Instant now);
    void pause_stop(base::Instant now);
    void forget_parameter();
    void begin_reset(base::Instant now);
    void raise(MidiFault fault, Limitation limitation = Limitation::none);
    /// Also ends a command that the module may have deferred.
    void raise_and_stop(MidiFault fault);
    void drop_orders();

    // Selection of the next message.
    void work(base::Instant now);
    MidiNext next_message(base::Instant now);
    MidiNext next_query(base::Instant now);
    MidiNext next_command(base::Instant now);
    MidiNext next_access();
    bool has_work(base::Instant now) const;

    // Effects of an order.
    void execute(const Order& order);
    void write(const Order& order);
    void write_word(unsigned number, std::uint16_t value);
    void reset_error();
    void begin_write();
    void finish_read();
    std::uint16_t read_word(unsigned number) const;
    std::uint32_t error_bits() const;
    std::optional<std::int32_t> target() const;

    MidiLink& link_;

    // Most used members first: a 16-bit Thumb load or store reaches only the first 32 to 128 bytes of an
    // object.
    bool stop_wanted_ = false;
    bool stop_hard_ = false;  ///< EMERGENCY_STOP instead of STOP
    bool reset_wanted_ = false;
    bool zero_wanted_ = false;
    bool zero_unclear_ = false;   ///< the next position decides
    bool status_is_new_ = false;  ///< GET_STATUS was answered after the last command
    bool access_error_ = false;   ///< ERROR was already set before the write
    std::uint8_t repeats_ = 0;    ///< of the pending command
    std::uint8_t refusals_ = 0;   ///< of the pending motion
    MidiFault fault_ = MidiFault::none;
    Limitation limitation_ = Limitation::none;
    MidiMotion motion_;
    MidiSession session_;
    MidiMessage message_;         ///< in progress while link_.busy()
    std::uint32_t asked_at_ = 0;  ///< time when it was sent, us modulo 2^32
    MidiDrive drive_;
    AccessSlot access_;
    std::uint32_t resent_ = 0;
    MidiOutcome probe_;
    base::Instant retry_at_{};  ///< of what was refused, and of a stop
    OrderQueue orders_;
    MidiRegisters registers_;
};

}  // namespace nplc::motor
