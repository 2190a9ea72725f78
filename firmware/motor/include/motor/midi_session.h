#pragma once

#include <cstdint>
#include <utility>

#include "base/time.h"
#include "motor/midi_link.h"
#include "motor/motor.h"
#include "motor/stop_pace.h"

namespace nplc::motor {

/// The link to a MIDI module: its start, the cyclic queries, and its loss.
class MidiSession {
  public:
    bool is_up() const { return phase_ == Phase::up; }
    bool is_down() const { return phase_ == Phase::down; }
    /// ERROR: the loss of the link is not acknowledged, or a reset is in progress.
    bool has_error() const { return link_error_ || resetting_; }
    bool link_error() const { return link_error_; }
    Link link() const;
    std::uint32_t losses() const { return losses_; }

    /// Nothing is received: a requested stop is sent nevertheless, in place of queries.
    bool is_blind() const { return blind_ && is_down(); }
    /// That stop is due, even during a message in progress.
    bool is_stop_due(base::Instant now) const { return is_blind() && now >= next_query_; }
    /// While it is not up: what is to be sent.
    MidiNext start_up(bool stop_wanted, base::Instant now);
    void begin_stop() { stop_pace_.begin_anew(); }
    /// A stop that was not confirmed: until it is sent again.
    base::Microseconds stop_pause() { return stop_pace_.next(); }
    /// While it is up: a query must be answered before anything else is sent.
    bool must_ask() const { return must_ask_; }
    /// The next cyclic query; nothing during the pause after the last answer.
    MidiNext next_query(bool needs_position, bool at_once, base::Instant now);
    /// While the line is free: the time of the next message; kNever if there is nothing to send.
    base::Instant next_send(bool has_work, base::Instant now) const;

    /// The message that was in progress when the link was lost has ended: its outcome is ignored.
    bool ends_old_message() { return std::exchange(ignore_, false); }
    void note_success() { failures_ = 0; }
    /// A message had no readable answer. True: the limit of failures in a row is reached and the link is
    /// lost.
    bool note_failure();
    /// A query was answered. True: the link has come up with it.
    bool on_answer(base::Microseconds pause, base::Instant now);
    /// The start-up query for Imax was refused: skips it.
    bool skips_refused();
    void ask_first() { must_ask_ = is_up(); }
    void ask_at(base::Instant when) { next_query_ = when; }

    /// `busy`: a message is under way. `stop_wanted`: it is sent at once. True if this is an error: the link
    /// had been up.
    bool lose(bool busy, bool stop_wanted, base::Instant now);
    /// While it is down: whether the last message was answered.
    void note_probe(bool answered) { blind_ = !answered; }
    /// A loss counts as an error even if the link was never up.
    void expect_up() { was_up_ = true; }
    void acknowledge() { link_error_ = false; }
    /// RESET was sent: the module does not answer for a while.
    void begin_reset(base::Instant now);
    /// The module has reported a restart. True if it was unexpected.
    bool on_boot(base::Instant now);
    /// A second drive at the address would have been detected by now.
    bool is_alone(base::Instant now) const { return now >= alone_at_; }

  private:
    enum class Phase : std::uint8_t { down, status, imax, speeds, settings, position, up, resetting };

    Phase phase_ = Phase::down;
    std::uint8_t failures_ = 0;  ///< in a row
    std::uint8_t turn_ = 0;      ///< of the queries
    StopPace stop_pace_;
    bool blind_ = false;
    bool must_ask_ = false;
    bool link_error_ = false;
    bool was_up_ = false;
    bool resetting_ = false;  ///< RESET was sent and the module does not answer again yet
    bool ignore_ = false;     ///< the message in progress is from before the loss of the link
    std::uint32_t losses_ = 0;
    base::Instant next_query_{};
    base::Instant deaf_until_{};
    base::Instant alone_at_{};
};

}  // namespace nplc::motor
