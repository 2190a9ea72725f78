#pragma once

#include <cstdint>

#include "base/time.h"
#include "motor/midi_drive.h"

namespace nplc::motor {

/// Follows what the shaft of a MIDI drive does. No query tells that it moves: it stands where two positions
/// are equal for long enough. The rules: MIDI.md in this folder.
class MidiMotion {
  public:
    enum class State : std::uint8_t {
        unknown,
        at_rest,
        going,  ///< to goal()
        running,
        stopping,
    };
    /// What a position tells that somebody has to act on.
    enum class Event : std::uint8_t {
        none,
        jumped,       ///< the motion does not explain the position
        not_taken,    ///< the command that nobody answered was not carried out
        end_stop,     ///< an end-stop has ended the motion
        not_arrived,  ///< it stands elsewhere than at goal()
    };

    State state() const { return state_; }
    bool at_rest() const { return state_ == State::at_rest; }
    bool moves() const { return state_ == State::going || state_ == State::running; }
    /// Although nobody here knows why.
    bool is_stray() const { return state_ == State::unknown && seen_moving_; }
    /// The module's position loop holds `goal`.
    bool holds(std::int32_t goal) const { return goal_holds_ && goal_ == goal; }
    bool has_arrived_at(std::int32_t goal) const { return at_rest() && arrived_ && holds(goal); }
    bool at_speed() const { return state_ == State::running && at_speed_; }
    /// Of a run.
    std::uint16_t period() const { return run_period_; }
    bool turns_left() const { return left_; }
    /// Nobody knows yet whether the motion's command was carried out.
    bool is_doubtful() const { return doubtful_; }
    bool needs_position(const MidiDrive& drive) const;
    /// A stop takes longer than it may.
    bool stops_late(base::Instant now) const { return state_ == State::stopping && now >= ramp_end_; }
    base::Instant ramp_end() const { return ramp_end_; }

    // Commands that the module has carried out.
    void begin_command() { steady_begun_ = measured_ = false; }
    void begin_move(std::int32_t goal);
    /// `run`: as RUN has it, period and direction.
    void begin_run(std::uint32_t run, const MidiDrive& drive, base::Instant now);
    void begin_stop(const MidiDrive& drive, base::Instant now);
    void begin_origin() { goal_holds_ = arrived_ = watched_ = false; }
    /// The command just begun may have been carried out or not.
    void doubt() { doubtful_ = true; }

    /// A command was refused because the shaft moves: it is stopping then, and not late before `at_least`.
    void wait_for_rest(base::Instant at_least);
    /// The link begins anew: perhaps the shaft still does what it did before.
    void restart();
    void forget();
    void forget_goal() { goal_holds_ = doubtful_ = false; }
    void drop_goal() { goal_holds_ = false; }
    void end_by_trip();
    /// To the place where it is: whether it is there is found out anew.
    void check_again(std::int32_t goal);
    /// The next position may be anywhere.
    void stop_watching() { watched_ = false; }

    void on_measures(const MidiDrive& drive, base::Instant now);
    /// `asked_at`: when the position was asked for, us modulo 2^32.
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
    bool measured_ = false;  ///< "not busy" is newer than the motion's command
    bool arrived_ = false;
    bool steady_begun_ = false;
    bool seen_moving_ = false;
    bool at_speed_ = false;
    bool watched_ = false;  ///< the last position is of this motion, at a speed that is known
    bool left_ = false;
    std::uint16_t run_period_ = 0;
    std::int32_t goal_ = 0;
    std::int32_t steady_position_ = 0;
    std::uint32_t position_asked_at_ = 0;
    base::Instant steady_since_{};
    base::Instant ramp_end_{};  ///< of a run, or the latest end of a stop
};

}  // namespace nplc::motor
