#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "base/ring.h"
#include "motor/midi_link.h"
#include "motor/midi_registers.h"
#include "motor/motor.h"
#include "registers/midi_motor.h"
#include "registers/vocabulary.h"

namespace nplc::motor {

/// Why a MidiMotor shows ERROR, for a person. A trip, and why no drive could do an order, are told by
/// MidiMotor::drive_status() and lack().
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

    MidiMotor(MidiLink& link, const Settings& settings);

    void poll(base::Instant now) override;
    void begin_orders(base::Instant now) override { work(now); }
    /// When to poll at the latest, asked after each poll() and each call that gives it something to do; `now`
    /// or earlier: at once.
    base::Instant next_poll(base::Instant now) const;
    bool settled() const override;
    bool can_execute(const Order& order) const override { return lack_of(order) == Lack::none; }
    bool has_room() const override { return !orders_.full(); }
    void send(const Order& order) override;
    void stop() override;
    bool begin_access(const Access& access) override;
    AccessState access_state() const override { return access_state_; }
    std::uint32_t access_value() const override { return access_value_; }
    void drop_access() override;
    bool in_position() const override;
    bool error() const override;
    std::uint8_t fault_number() const override { return static_cast<std::uint8_t>(fault_); }
    Link link() const override;
    Counters counters() const override { return counters_; }
    bool longwords_only() const override { return false; }

    using Lack = registers::midi::Lack;
    Lack lack_of(const Order& order) const;

    /// The first reason for the present ERROR; stays until "reset error" (01h).
    MidiFault fault() const;
    Lack lack() const { return lack_; }                        ///< of a `bad_value`
    std::uint32_t drive_status() const { return status_; }     ///< GET_STATUS, as last heard
    std::int32_t drive_position() const { return position_; }  ///< increments, as last heard
    /// How the last message ended while the link was down.
    const MidiOutcome& probe() const { return probe_; }

  private:
    enum class Phase : std::uint8_t { down, status, imax, speeds, settings, position, up, resetting };
    enum class Motion : std::uint8_t {
        unknown,
        at_rest,
        going,  ///< to goal_
        running,
        stopping,
    };
    using Message = std::optional<MidiMessage>;
    /// Of one command; and failures in a row until the link is down.
    static constexpr std::uint8_t kMostRepeats = 3;

    // midi_motor.cpp: the link and its messages
    void lose_link(MidiFault why, base::Instant now);
    void drop_orders();
    void look_for_trouble(base::Instant now);
    void work(base::Instant now);
    Message next_message(base::Instant now);
    Message start_up_query() const;
    Message next_query(base::Instant now);
    bool has_work() const;
    void end_access(AccessState state);
    void on_boot(base::Instant now);
    void on_outcome(const MidiOutcome& outcome, base::Instant now);
    void on_unclear(base::Instant now);
    void on_refused(base::Instant now);
    void on_refused_motion(base::Instant now);
    void on_accepted(base::Instant now);
    void begin_motion(Motion motion, base::Instant now);
    void begin_stop(base::Instant now);
    void begin_reset(base::Instant now);
    void forget_parameter();

    // midi_explained.cpp: does the motion explain a position?
    bool is_explained(base::Instant now);

    // midi_replies.cpp: what the module tells
    void on_value(std::uint32_t value, base::Instant now);
    void keep(std::uint32_t value, base::Instant now);
    void on_status();
    void on_measures(base::Instant now);
    void on_position(base::Instant now);
    void check_still_there();
    void check_steady(base::Instant now);
    void conclude(base::Instant now);
    void not_taken_after_all();
    void give_up(MidiFault why);
    bool needs_position() const;
    bool is_within(std::int32_t slack) const;  ///< of goal_
    std::int32_t slack() const;
    base::Microseconds steady_time() const;
    std::uint32_t error_bits() const;
    std::uint16_t read_word(unsigned number) const;
    std::int32_t speed() const;
    void finish_access();
    Message serve_access();
    void begin_write();

    // midi_plan.cpp: from registers to commands
    void execute(const Order& order);
    void execute_number(std::uint8_t number);
    void write(const Order& order);
    void recheck();
    void write_word(unsigned number, std::uint16_t value);
    void reset_error();
    Message next_command(base::Instant now);
    Message next_for_run();
    Message next_for_move();
    Message stop_first();
    bool ramp_fits(std::uint16_t period, std::uint8_t& ramp);
    std::uint16_t mode() const { return registers_.word(registers::MODE_REG); }
    std::int32_t v_soll() const;
    std::optional<std::int32_t> target() const;
    bool may_move() const;
    void raise(MidiFault fault, Lack lack = Lack::none);
    /// It turns since before the error, and nobody leads it any more.
    bool is_stray() const { return motion_ == Motion::unknown && seen_moving_ && error(); }
    bool moves() const { return motion_ == Motion::going || motion_ == Motion::running; }

    MidiLink& link_;
    MidiMessage message_;  ///< under way while link_.busy()

    // What is used most stands in front, where a Cortex-M's short instructions reach it.
    Phase phase_ = Phase::down;
    Motion motion_ = Motion::unknown;
    bool goal_holds_ = false;  ///< the module's position loop has it
    bool doubtful_ = false;    ///< nobody knows yet whether the motion's command was taken
    bool measured_ = false;    ///< not_busy_ is newer than the motion's command
    bool arrived_ = false;
    bool steady_begun_ = false;
    bool seen_moving_ = false;   ///< although nobody here knows why
    std::uint8_t failures_ = 0;  ///< in a row
    std::uint8_t repeats_ = 0;   ///< of the command that is to be sent
    std::uint8_t refusals_ = 0;
    AccessState access_state_ = AccessState::none;
    bool stop_wanted_ = false;
    bool stop_hard_ = false;   ///< EMERGENCY_STOP instead of STOP
    bool order_open_ = false;  ///< an order was begun whose commands are not all through
    MidiFault fault_ = MidiFault::none;

    Model model_;
    Lack lack_ = Lack::none;
    std::uint8_t turn_ = 0;         ///< of the queries
    std::uint8_t blind_stops_ = 0;  ///< to be sent while the link is down
    bool link_error_ = false;
    bool was_up_ = false;
    bool resetting_ = false;  ///< RESET was sent and the module is not back yet
    bool ignore_ = false;     ///< the message under way is from before the link was lost
    bool reset_wanted_ = false;
    bool zero_wanted_ = false;
    bool zero_unclear_ = false;   ///< the next position tells
    bool relative_ = false;       ///< RELPOSPSOLL
    bool resync_ = false;         ///< a query must be answered before anything else is sent
    bool status_is_new_ = false;  ///< since the last command
    bool left_ = false;
    bool not_busy_ = false;
    bool at_speed_ = false;
    bool watched_ = false;         ///< position_ is of this motion, at a speed that is known
    std::uint8_t referenced_ = 0;  ///< the reference input in the last eight measures, the latest in bit 0
    bool access_error_ = false;    ///< ERROR was there before the write
    std::uint8_t base_ = 0;        ///< 7 or 8: P_SOLL becomes the next position plus P7 or P8

    // of the module
    std::uint8_t imax_ = registers::midi::kMostTorque;
    std::uint8_t unstall_ = 0;
    std::uint8_t ramp_ = 0;
    std::uint8_t torque_ = 0;
    std::uint8_t tolerance_ = 0;
    std::uint16_t period_ = 0;
    std::uint16_t run_period_ = 0;
    std::uint32_t status_ = 0;
    std::int32_t position_ = 0;
    std::int32_t position_before_ = 0;
    std::uint32_t asked_at_ = 0;           ///< us, modulo 2^32: the message under way
    std::uint32_t position_asked_at_ = 0;  ///< and the last position
    std::int32_t goal_ = 0;
    std::int32_t steady_position_ = 0;

    std::uint32_t access_value_ = 0;
    MidiOutcome probe_;
    Counters counters_;
    base::Ring<Order, 8> orders_;
    Access access_;
    base::Instant position_at_{};
    base::Microseconds position_step_{};  ///< between the two; 0: not known
    base::Instant steady_since_{};
    base::Instant ramp_end_{};  ///< of a run, or the latest end of a stop
    base::Instant next_query_{};
    base::Instant retry_at_{};
    base::Instant deaf_until_{};
    base::Instant alone_at_{};  ///< another drive at the address would have shown by then
    MidiRegisters registers_;
};

}  // namespace nplc::motor
