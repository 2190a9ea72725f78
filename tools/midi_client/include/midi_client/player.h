#pragma once

#include "midi_client/feed.h"
#include "midi_client/master.h"

/// Motion of several axes together.
namespace nplc::midi_client {

/// It was not carried out to its end, and why. Nothing moves any more, unless the text says so.
class NotPlayed : public mactalk_client::EndedWith<mactalk_client::kRefused> {
    using EndedWith::EndedWith;
};

struct PlayOptions {
    std::function<bool()> goes_on{};              ///< false: stop, and throw Interrupted
    std::function<void(double part)> progress{};  ///< 0..1
    /// How long an answer may be late beyond the line's own time without a FIFO running empty.
    base::Microseconds reserve{20'000};
};

/// Turns all axes along `plan` at the same time, from where they stand. All modules get one pause (1Eh) by a
/// general message and so begin together; segments are fed while it lasts. Three short pauses fill each FIFO
/// first and the next one must be refused: so it is known, before anything turns, that each module waits.
/// A general message reaches every module on the line; those that are not in the plan stand for a while with
/// their power on.
///
/// Throws NotPlayed, LineError and Interrupted, after it has stopped all axes with 18h.
void play(Master& master, const Plan& plan, const PlayOptions& options = {});

struct Target {
    std::uint8_t address = 0;
    std::int32_t position = 0;
};

/// Moves of their own speed and ramp that begin at the same time: 10h and 13h to each, then 11h or SYNC. Ends
/// when all stand at their targets. Throws as `play` does.
void go_together(Master& master, const std::vector<Target>& targets, const PlayOptions& options = {});

/// Until this axis has reached its target. Throws NotPlayed if it stops elsewhere; does not stop it, and lets
/// `goes_on` decide about going on. `seen` gets each position read.
void await_arrival(Master& master, const Target& target, const std::function<bool()>& goes_on,
                   const std::function<void(std::int32_t)>& seen = {});

/// "tripped: too hot; stopped by the upper software stop": what in a status word keeps an axis from moving.
std::string obstacles(std::uint32_t status);

}  // namespace nplc::midi_client
