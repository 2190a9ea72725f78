#include "gateway/chosen_motor.h"

#include "gateway/settings_keeper.h"

namespace nplc::gateway {

using store::MotorKind;
using store::Setting;

namespace {

motor::MidiMotor::Model model_of(const store::SettingValues& values) {
    using Model = motor::MidiMotor::Model;
    switch (static_cast<MotorKind>(values.get(Setting::motor_kind))) {
        case MotorKind::mac23:
            return Model::mac23;
        case MotorKind::mac34_2:
            return Model::mac34_2;
        case MotorKind::jvl:
        case MotorKind::mac34_1:
            break;
    }
    return Model::mac34_1;
}

}  // namespace

ChosenMotor::Midi::Midi(ports::SerialPort& line, const store::SettingValues& values)
    : link(line, {.address = static_cast<std::uint8_t>(values.get(Setting::midi_address)),
                  .baud = values.get(Setting::motor_baud)}),
      motor(link, {.model = model_of(values)}) {}

ChosenMotor::ChosenMotor(ports::SerialPort& line, const store::SettingValues& values)
    : motor_(start(line, values)) {}

motor::Motor& ChosenMotor::start(ports::SerialPort& line, const store::SettingValues& values) {
    if (static_cast<MotorKind>(values.get(Setting::motor_kind)) == MotorKind::jvl)
        return driver_.emplace<motor::JvlMotor>(line, driver_settings_of(values));
    return driver_.emplace<Midi>(line, values).motor;
}

}  // namespace nplc::gateway
