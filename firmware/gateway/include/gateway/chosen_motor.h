#pragma once

#include <variant>

#include "motor/jvl_motor.h"
#include "motor/midi_motor.h"
#include "motor/midi_v24_link.h"
#include "store/settings.h"

namespace nplc::gateway {

/// The driver of the motor that setting motor_kind names, on a serial line. All kinds have the same memory.
class ChosenMotor {
  public:
    ChosenMotor(ports::SerialPort& line, const store::SettingValues& values);
    ChosenMotor(const ChosenMotor&) = delete;
    ChosenMotor& operator=(const ChosenMotor&) = delete;

    motor::Motor& motor() { return motor_; }

  private:
    struct Midi {
        Midi(ports::SerialPort& line, registers::midi::Model model, std::uint8_t address, std::uint32_t baud);

        motor::MidiV24Link link;
        motor::MidiMotor motor;
    };

    motor::Motor& start(ports::SerialPort& line, const store::SettingValues& values);

    std::variant<std::monostate, motor::JvlMotor, Midi> driver_;
    motor::Motor& motor_;
};

}  // namespace nplc::gateway
