#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "base/time.h"
#include "motor/midi_link.h"
#include "motor/motor.h"

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

    /// While the link is not up: the next message to send.
    std::optional<MidiMessage> start_up(base::Instant now);
    /// While the link is up: a query must be answered before anything else is sent.
    bool must_ask() const { return must_ask_; }
    /// The next cyclic query; empty during the pause after the last answer.
    std::optional<MidiMessage> next_query(bool needs_position, bool at_once, base::Instant now);
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

    /// `busy`: a message is in progress. `stop_blindly`: stops are sent although no answer can be read. True
    /// if this is an error because the link had been up.
    bool lose(bool busy, bool stop_blindly, base::Instant now);
    /// The next loss counts as an error even if the link was never up.
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
    std::uint8_t failures_ = 0;     ///< in a row
    std::uint8_t turn_ = 0;         ///< position in the query cycle
    std::uint8_t blind_stops_ = 0;  ///< to be sent while the link is down
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
