#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "base/time.h"
#include "motor/midi_link.h"
#include "motor/motor.h"

namespace nplc::motor {

/// Whether a MIDI module answers: how the link to it starts, what is asked in turn, and when it is lost.
class MidiSession {
  public:
    bool is_up() const { return phase_ == Phase::up; }
    bool is_down() const { return phase_ == Phase::down; }
    /// ERROR: the link went down and nobody has acknowledged it, or a reset is under way.
    bool has_error() const { return link_error_ || resetting_; }
    bool link_error() const { return link_error_; }
    Link link() const;
    std::uint32_t losses() const { return losses_; }

    /// While it is not up: what is to be sent.
    std::optional<MidiMessage> start_up(base::Instant now);
    /// While it is up: a query must be answered before anything else is sent.
    bool must_ask() const { return must_ask_; }
    /// What is asked in turn; nothing while the pause after the last answer lasts.
    std::optional<MidiMessage> next_query(bool needs_position, bool at_once, base::Instant now);
    /// While the link is free: when it has something to send; nothing to wait for is kNever.
    base::Instant next_send(bool has_work, base::Instant now) const;

    /// The message under way when the link was lost has ended: it counts no more.
    bool ends_old_message() { return std::exchange(ignore_, false); }
    void note_success() { failures_ = 0; }
    /// A message without a readable answer. True: so many in a row that the link is lost.
    bool note_failure();
    /// A query was answered. True: with it the link has come up.
    bool on_answer(base::Microseconds pause, base::Instant now);
    /// The start's query for Imax was refused: it is left out.
    bool skips_refused();
    void ask_first() { must_ask_ = is_up(); }
    void ask_at(base::Instant when) { next_query_ = when; }

    /// `busy`: a message is under way. `stop_blindly`: stops are sent though no answer can be read. True if
    /// this is an error: the link had been up.
    bool lose(bool busy, bool stop_blindly, base::Instant now);
    /// A loss counts as an error even if the link was never up.
    void expect_up() { was_up_ = true; }
    void acknowledge() { link_error_ = false; }
    /// RESET was sent: the module is deaf for a while.
    void begin_reset(base::Instant now);
    /// The module has said that it started anew. True if nobody expected that.
    bool on_boot(base::Instant now);
    /// Another drive at the address would have shown by now.
    bool is_alone(base::Instant now) const { return now >= alone_at_; }

  private:
    enum class Phase : std::uint8_t { down, status, imax, speeds, settings, position, up, resetting };

    Phase phase_ = Phase::down;
    std::uint8_t failures_ = 0;     ///< in a row
    std::uint8_t turn_ = 0;         ///< of the queries
    std::uint8_t blind_stops_ = 0;  ///< to be sent while the link is down
    bool must_ask_ = false;
    bool link_error_ = false;
    bool was_up_ = false;
    bool resetting_ = false;  ///< RESET was sent and the module is not back yet
    bool ignore_ = false;     ///< the message under way is from before the link was lost
    std::uint32_t losses_ = 0;
    base::Instant next_query_{};
    base::Instant deaf_until_{};
    base::Instant alone_at_{};
};

}  // namespace nplc::motor
