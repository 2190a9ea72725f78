#pragma once

#include "motor/driver.h"
#include "motor/jvl_motor.h"

namespace nplc::motor::jvl {

JvlMotor::Settings settings_of(const DriverSettings& settings);

/// A JVL MAC motor, on a serial line.
struct Driver {
    static constexpr bool drives(const DriverPorts& ports, std::uint8_t motor_kind) {
        return ports.serial != nullptr && motor_kind == 0;
    }
    Driver(const DriverPorts& ports, const DriverSettings& settings)
        : motor(*ports.serial, settings_of(settings)) {}

    JvlMotor motor;
};

}  // namespace nplc::motor::jvl
