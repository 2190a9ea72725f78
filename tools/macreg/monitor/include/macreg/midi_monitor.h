#pragma once

#include "macreg/monitor.h"
#include "registers/midi.h"

namespace nplc::macreg {

struct MidiMonitorOptions {
    std::optional<registers::midi::Model> model{};  ///< for turns; without it increments
    std::uint32_t baud = registers::midi::kFactoryBaud;
    base::Microseconds longest_answer{150'000};  ///< beyond the line's time
};

/// MIDI Ingenierie's serial line (000 §II to §IV). Requests and answers may come in one stream or in one
/// each. An answer to a command carries no address: it is paired with the last request.
std::unique_ptr<Monitor> make_midi_monitor(const MidiMonitorOptions& options);

}  // namespace nplc::macreg
