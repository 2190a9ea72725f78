#include "drive_parts.h"

#include <fmt/format.h>

namespace nplc::sim {
namespace {

std::string_view why_midi_without(DrivePart part) {
    switch (part) {
        case DrivePart::brake:
            return "has no holding brake";
        case DrivePart::spring:
            return "has rigid stops only here; leave spring out";
        case DrivePart::analogue_input:
            return "has no analogue input; write motor upper_stop, lower_stop, reference or security";
        case DrivePart::pulse_input:
            return "has no pulse input";
        case DrivePart::logic_supply:
            return "has one supply for all (003 §II.1); write motor supply";
        case DrivePart::plant:
            return "has a shaft of its own here that takes no plant file; write motor load";
        case DrivePart::temperature:
        case DrivePart::encoder:
        case DrivePart::inputs:
            return {};
    }
    return {};
}

std::string_view why_small_without(DrivePart part, bool beside_fastmac) {
    switch (part) {
        case DrivePart::brake:
            return "has no output for a holding brake; only a MAC800 has";
        case DrivePart::pulse_input:
            if (!beside_fastmac) return {};
            return "has FastMAC on the pins of its pulse input (001 §3.2.36, USERINTF), so V_EXT stays 0; "
                   "only a "
                   "MAC800 has both, and macsim without --fastmac leaves the pins free";
        case DrivePart::logic_supply:
            return "has one supply; write motor supply";
        case DrivePart::temperature:
            return "does not measure its temperature; a MAC800 does, and MIDI drives do";
        case DrivePart::encoder:
            return "does not notice a broken encoder; a MAC800 does, and MIDI drives do";
        default:
            return {};
    }
}

}  // namespace

std::string why_without(DrivePart part, const Names& names) {
    std::string_view name = registers::name_of(names.motor);
    std::string_view why;
    if (names.drive != nullptr) {
        name = names.drive->name;
        why = why_midi_without(part);
    } else if (part == DrivePart::inputs) {
        why = "has no such input; MIDI drives have (--motor MAC34-1). Write motor sensor, or motor stop";
    } else if (names.motor != registers::Model::mac800) {
        why = why_small_without(part, !names.free_pins);
    }
    return why.empty() ? std::string() : fmt::format("a {} {}", name, why);
}

}  // namespace nplc::sim
