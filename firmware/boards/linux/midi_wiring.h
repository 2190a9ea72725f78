#pragma once

#include <array>
#include <string>
#include <vector>

#include "motor_config.h"

namespace nplc::boards {

/// Signal, this board, level, the other end.
using WiringRow = std::array<std::string, 4>;

/// Of a MIDI drive's line, with pins as far as the manuals give them (003 §VIII).
std::vector<WiringRow> midi_rows(const MotorConfig& motor);
/// The drive's other connectors and what to mind, in lines below the table.
std::string midi_notes(const MotorConfig& motor);

}  // namespace nplc::boards
