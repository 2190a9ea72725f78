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

/// Why a MidiMotor shows ERROR, for a user. A trip, and why no drive could do an order, are told by
/// MidiMotor::drive_status() and limitation().
using MidiFault = registers::gateway::DriveFault;

/// What it is and what to do. Without a full stop.
std::string_view text_of(MidiFault fault);

/// A MAC23 or MAC34 of MIDI Ingenierie behind any of its lines. It keeps the registers that a sequence knows
/// from a JVL motor, and leads the drive to what they say. The rules and the whole translation: MIDI.md in
/// this folder.
class MidiMotor final : public Motor {
  public:
    using Model = registers::midi::Model;
    struct Settings {
        Model model = Model::mac34_1;
    };

    MidiMotor(MidiLink& link, const Settings& settings) : link_(link), drive_(settings.model) {}

    void poll(base::Instant now) override;
    void begin_orders(base::Instant now) override { work(now); }
    /// When to poll at the latest, asked after each poll() and each call that gives it something to do; `now`
    /// or earlier: at once.
    base::Instant next_poll(base::Instant now) const;
    bool settled() const override;
    bool can_execute(const Order& order) const override { return limitation_of(order) == Limitation::none; }
    bool has_room() const override { return !orders_.full(); }
    void send(const Order& order) override { orders_.push(order, session_.is_up()); }
    void stop() override;
    bool stop_confirmed() const override { return !stop_wanted_; }
    void give_up_stop() override { stop_wanted_ = stop_hard_ = false; }
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

    /// The first reason for the present ERROR; stays until "reset error" (01h).
    MidiFault fault() const;
    Limitation limitation() const { return limitation_; }           ///< of a `bad_value`
    std::uint32_t drive_status() const { return drive_.status(); }  ///< GET_STATUS, as last heard
    const MidiDrive& drive() const { return drive_; }
    bool is_at_target() const { return registers_.mode() == 2 && in_position(); }
    /// A mode that moves, and V_SOLL 0, which holds every move back.
    bool has_no_speed() const {
        return registers_.mode() != 0 && registers_.is_set(registers::V_SOLL) && registers_.v_soll() == 0;
    }
    /// How the last message ended while the link was down.
    const MidiOutcome& probe() const { return probe_; }

  private:
    using Message = std::optional<MidiMessage>;

    // How messages end.
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
    void forget_parameter();
    void begin_reset(base::Instant now);
    void raise(MidiFault fault, Limitation limitation = Limitation::none);
    /// Whatever the module was told that waits is ended too.
    void raise_and_stop(MidiFault fault);
    void drop_orders();

    // Which message is sent next.
    void work(base::Instant now);
    Message next_message(base::Instant now);
    Message next_query(base::Instant now);
    Message next_command(base::Instant now);
    Message next_access();
    bool has_work() const;

    // What an order does.
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

    // What is used most stands in front, where a Cortex-M's short instructions reach it.
    bool stop_wanted_ = false;
    bool stop_hard_ = false;  ///< EMERGENCY_STOP instead of STOP
    bool reset_wanted_ = false;
    bool zero_wanted_ = false;
    bool zero_unclear_ = false;   ///< the next position tells
    bool status_is_new_ = false;  ///< since the last command
    bool access_error_ = false;   ///< ERROR was there before the write
    std::uint8_t repeats_ = 0;    ///< of the command that is to be sent
    std::uint8_t refusals_ = 0;   ///< of the motion that is to begin
    MidiFault fault_ = MidiFault::none;
    Limitation limitation_ = Limitation::none;
    MidiMotion motion_;
    MidiSession session_;
    MidiMessage message_;         ///< under way while link_.busy()
    std::uint32_t asked_at_ = 0;  ///< us, modulo 2^32: when it was sent
    MidiDrive drive_;
    AccessSlot access_;
    std::uint32_t resent_ = 0;
    MidiOutcome probe_;
    base::Instant retry_at_{};
    OrderQueue orders_;
    MidiRegisters registers_;
};

}  // namespace nplc::motor
