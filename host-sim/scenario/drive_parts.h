#pragma once

#include <cstdint>
#include <string>

#include "sim/snapshot.h"

namespace nplc::sim {

/// What a drive may have, or have around it, that a scenario can act upon.
enum class DrivePart : std::uint8_t {
    brake,
    spring,  ///< at a mechanical stop
    analogue_input,
    pulse_input,
    logic_supply,
    temperature,
    encoder,  ///< one that is noticed when it breaks
    inputs,   ///< of a MIDI module
    plant,    ///< a file of one
};

/// Why the drive has none and what to write instead, without a full stop; empty if it has.
std::string why_without(DrivePart part, const Names& names);

}  // namespace nplc::sim
