#pragma once

#include "motor/midi_can_link.h"
#include "motor/midi_driver.h"

namespace nplc::motor::midi {

/// A MIDI drive on CAN.
struct CanDriver {
    static constexpr bool drives(const DriverPorts& ports, std::uint8_t motor_kind) {
        return ports.can != nullptr && is_kind(motor_kind);
    }
    CanDriver(const DriverPorts& ports, const DriverSettings& settings)
        : link(*ports.can, {.address = settings.address}), motor(link, settings_of(settings)) {}

    MidiCanLink link;
    MidiMotor motor;
};

}  // namespace nplc::motor::midi
