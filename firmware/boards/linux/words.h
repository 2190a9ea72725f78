#pragma once

#include <optional>
#include <string>

#include "gateway/event_log.h"
#include "gateway/run_state.h"
#include "journal.h"
#include "motor/midi_motor.h"

namespace nplc::boards {

struct Said {
    LogLevel level;
    std::string text;
};
/// An entry of the gateway's log for a person: what happened, and for a fault what to do.
Said in_words(const gateway::EventLog::Entry& entry);
/// Why a MIDI drive shows ERROR; nothing without a cause, and for a lost link, which the log tells.
std::optional<Said> in_words(const motor::MidiMotor& motor);

}  // namespace nplc::boards
