#pragma once

#include <cstdint>

#include "base/time.h"
#include "motor/midi_drive.h"

namespace nplc::motor {

/// Tracks the motion of a MIDI drive's shaft. No query reports motion directly: the shaft is at standstill
/// when two positions are equal for long enough. The rules: MIDI.md in this folder.
class MidiMotion {
  public:
    enum class State : std::uint8_t {
        unknown,
        at_rest,
        going,  ///< to goal()
        running,
        stopping,
    };
    /// A result of a position query that needs a reaction.
    enum class Event : std::uint8_t {
        none,
        jumped,       ///< the position does not fit the motion
        not_taken,    ///< the unanswered command was not carried out
        end_stop,     ///< an end-stop has ended the motion
        not_arrived,  ///< standstill at another position than goal()
    };

    State state() const { return state_; }
    bool at_rest() const { return state_ == State::at_rest; }
    bool moves() const { return state_ == State::going || state_ == State::running; }
    /// The shaft moves for an unknown reason.
    bool unexpected_motion() const { return state_ == State::unknown && seen_moving_; }
    /// The module's position loop holds `goal`.
    bool holds(std::int32_t goal) const { return goal_holds_ && goal_ == goal; }
    bool has_arrived_at(std::int32_t goal) const { return at_rest() && arrived_ && holds(goal); }
    bool at_speed() const { return state_ == State::running && at_speed_; }
    /// For a run.
    std::uint16_t period() const { return run_period_; }
    bool turns_left() const { return left_; }
    /// It is unknown whether the motion's command was carried out.
    bool motion_unconfirmed() const { return doubtful_; }
    bool needs_position(const MidiDrive& drive) const;
    /// The stop has exceeded its time limit.
    bool stops_late(base::Instant now) const { return state_ == State::stopping && now >= ramp_end_; }
    base::Instant ramp_end() const { return ramp_end_; }

    // After commands that the module has carried out.
    void begin_command() { steady_begun_ = measured_ = false; }
    void begin_move(std::int32_t goal);
    /// `run`: period and direction, coded as in RUN.
    void begin_run(std::uint32_t run, const MidiDrive& drive, base::Instant now);
    void begin_stop(const MidiDrive& drive, base::Instant now);
    void begin_origin() { goal_holds_ = arrived_ = watched_ = false; }
    /// It is unknown whether the command just begun was carried out.
    void doubt() { doubtful_ = true; }

    /// A command was refused because the shaft moves: waits for standstill, with a time limit not before
    /// `at_least`.
    void wait_for_rest(base::Instant at_least);
    /// The link starts again: the shaft may still be doing what it did before.
    void restart();
    void forget();
    void forget_goal() { goal_holds_ = doubtful_ = false; }
    void drop_goal() { goal_holds_ = false; }
    void end_by_trip();
    /// After a new order for the position already reached: checks again that the shaft is there.
    void check_again(std::int32_t goal);
    /// Suspends the jump check for the next position.
    void stop_watching() { watched_ = false; }

    void on_measures(const MidiDrive& drive, base::Instant now);
    /// `asked_at`: time of the position query, us modulo 2^32.
    Event on_position(const MidiDrive& drive, std::uint32_t asked_at, base::Instant now);

  private:
    void begin(State state);
    bool is_explained(const MidiDrive& drive, std::uint32_t asked_at, base::Instant now);
    bool has_ended(const MidiDrive& drive) const;
    bool is_within(const MidiDrive& drive, std::int32_t slack) const;
    void check_still_there(const MidiDrive& drive);
    Event check_steady(const MidiDrive& drive, base::Instant now);
    Event conclude(const MidiDrive& drive);
    std::int32_t slack() const;
    base::Microseconds steady_time(const MidiDrive& drive) const;

    State state_ = State::unknown;
    bool goal_holds_ = false;
    bool doubtful_ = false;
    bool measured_ = false;  ///< measures have been read since the motion's command
    bool arrived_ = false;
    bool steady_begun_ = false;
    bool seen_moving_ = false;
    bool at_speed_ = false;
    bool watched_ = false;  ///< the last position belongs to this motion, and its speed is known
    bool left_ = false;
    std::uint16_t run_period_ = 0;
    std::int32_t goal_ = 0;
    std::int32_t steady_position_ = 0;
    std::uint32_t position_asked_at_ = 0;
    base::Instant steady_since_{};
    base::Instant ramp_end_{};  ///< end of a run's ramp, or the time limit of a stop
};

}  // namespace nplc::motor
