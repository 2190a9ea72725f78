#include "gateway/chosen_motor.h"

#include "gateway/settings_keeper.h"
#include "registers/gateway.h"

namespace nplc::gateway {

using registers::gateway::model_of_kind;
using store::Setting;

ChosenMotor::Midi::Midi(ports::SerialPort& line, registers::midi::Model model, std::uint8_t address,
                        std::uint32_t baud)
    : link(line, {.address = address, .baud = baud}), motor(link, {.model = model}) {}

ChosenMotor::ChosenMotor(ports::SerialPort& line, const store::SettingValues& values)
    : motor_(start(line, values)) {}

motor::Motor& ChosenMotor::start(ports::SerialPort& line, const store::SettingValues& values) {
    const auto model = model_of_kind(values.get(Setting::motor_kind));
    if (!model) return driver_.emplace<motor::JvlMotor>(line, driver_settings_of(values));
    const auto address = static_cast<std::uint8_t>(values.get(Setting::midi_address));
    return driver_.emplace<Midi>(line, *model, address, values.get(Setting::motor_baud)).motor;
}

}  // namespace nplc::gateway
