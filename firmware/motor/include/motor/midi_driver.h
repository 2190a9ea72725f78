#pragma once

#include "motor/driver.h"
#include "motor/midi_motor.h"
#include "motor/midi_v24_link.h"

namespace nplc::motor::midi {

/// Setting motor_kind: 0 is a JVL motor, 1 to 3 are the MIDI models.
constexpr bool is_kind(std::uint8_t motor_kind) {
    return motor_kind >= 1 && motor_kind <= 3;
}
constexpr MidiMotor::Settings settings_of(const DriverSettings& settings) {
    return {.model = static_cast<MidiMotor::Model>(settings.motor_kind - 1)};
}

/// A MIDI drive on V24. On CAN: motor/midi_can_driver.h, which boards without a CAN bus do not have.
struct Driver {
    static constexpr bool drives(const DriverPorts& ports, std::uint8_t motor_kind) {
        return ports.serial != nullptr && is_kind(motor_kind);
    }
    Driver(const DriverPorts& ports, const DriverSettings& settings)
        : link(*ports.serial, {.address = settings.address, .baud = settings.baud}),
          motor(link, settings_of(settings)) {}

    MidiV24Link link;
    MidiMotor motor;
};

}  // namespace nplc::motor::midi
