#pragma once

#include <cstdint>
#include <string>

#include "sim/snapshot.h"

namespace nplc::sim {

/// Parts of a drive or its environment that a scenario can act on.
enum class DrivePart : std::uint8_t {
    brake,
    spring,  ///< at a mechanical stop
    analogue_input,
    pulse_input,
    logic_supply,
    temperature,
    encoder,  ///< one whose failure is detected
    inputs,   ///< of a MIDI module
    plant,    ///< a file of one
};

/// Why the drive has no such part and what to write instead, without a full stop; empty if it has.
std::string why_without(DrivePart part, const Names& names);

}  // namespace nplc::sim
