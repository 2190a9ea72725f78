#pragma once

#include <array>
#include <cstdint>

#include "registers/midi.h"

namespace nplc::sim {

/// Non-volatile data of a MIDI module (000 §VI 08h to 0Fh, 1Bh, 20h; R: 02h, 03h and 1Ch as well).
struct MidiMemory {
    std::uint8_t address = 0;
    std::uint8_t baud_code = 3;
    std::int32_t upper_stop = registers::midi::kMaxPosition;
    std::int32_t lower_stop = registers::midi::kMinPosition;
    std::uint8_t torque = registers::midi::kMostTorque;
    std::uint16_t period = 480;
    std::uint8_t unstall = 5;
    std::uint8_t ramp = 16;
    bool standby = true;
    static constexpr std::uint8_t kHardwareStops = 1;  ///< in `stops`
    static constexpr std::uint8_t kSoftwareStops = 8;
    std::uint8_t stops = 0;
    std::uint8_t tolerance = 0;
    std::int32_t position = 0;
    bool operator==(const MidiMemory&) const = default;
};

/// The EEPROM, with a write counter.
struct MidiEeprom {
    MidiMemory values;
    std::uint32_t writes = 0;

    void write(const MidiMemory& to) {
        if (values == to) return;
        values = to;
        ++writes;
    }
    void write_position(std::int32_t position) {
        if (values.position == position) return;
        values.position = position;
        ++writes;
    }
};

/// Factory settings (000 §VI 01h). Address 00 on V24 and 1 on CAN, 38400 baud and tolerance 0 are from the
/// manuals; R: the rest is an own choice: full torque, 100 rpm on MAC34 and 300 rpm on MAC23, unstall 1 ms an
/// increment, a ramp of 1920 increments, standby, no stops. The position is not a factory setting.
MidiMemory factory_memory(registers::midi::Model model, bool can, std::uint8_t imax);

/// The EEPROM as GET_EEPROM reads it. R: no manual gives the places; unused bytes are FFh.
std::array<std::uint8_t, 256> eeprom_image(const MidiMemory& memory);

}  // namespace nplc::sim
