#include "action_parser.h"

namespace nplc::sim {
namespace {

constexpr std::string_view kMotor =
    "motor error, motor load, motor brake, motor power, motor stop, motor sensor, motor analogue, motor "
    "pulses, motor steps, motor supply, motor logic, motor temperature or motor encoder";

}  // namespace

void ActionParser::motor(Actions& list, Time after) {
    if (reader_.take("error")) return add(list, after, action::FailMotor{});
    if (reader_.take("load")) return add(list, after, motor_load());
    if (reader_.take("brake")) return add(list, after, motor_brake());
    if (reader_.take("power")) return add(list, after, motor_power());
    if (reader_.take("stop")) return motor_stop(list, after);
    if (reader_.take("sensor")) return add(list, after, motor_sensor());
    if (reader_.take("analogue")) return add(list, after, motor_analogue());
    if (reader_.take("pulses")) return add(list, after, motor_pulses(false));
    if (reader_.take("steps")) return add(list, after, motor_pulses(true));
    if (reader_.take("supply")) return add(list, after, motor_supply(false));
    if (reader_.take("logic")) return add(list, after, motor_supply(true));
    if (reader_.take("temperature")) return add(list, after, motor_temperature());
    if (reader_.take("encoder")) {
        reader_.want("broken", "motor encoder broken");
        return add(list, after, action::BreakEncoder{});
    }
    reader_.fail(kMotor);
}

int ActionParser::whole(std::string_view what, double least, double most, std::string_view mistake) {
    const double number = reader_.number(what);
    if (number < least || number > most || number != static_cast<double>(static_cast<int>(number))) {
        throw LineMistake{std::string(mistake)};
    }
    return static_cast<int>(number);
}

action::LoadMotor ActionParser::motor_load() {
    return {whole("a torque, such as motor load 500", -10'000, 10'000,
                  "a load is a whole number -10000 to 10000, 1023 being the motor's full torque")};
}

action::MotorBrake ActionParser::motor_brake() {
    return {whole("a torque, such as motor brake 300", 0, 10'000,
                  "a brake is a whole number 0 to 10000, 1023 being the motor's full torque")};
}

action::PowerMotor ActionParser::motor_power() {
    if (reader_.take("off")) return {false};
    reader_.want("on", "motor power off, or motor power on");
    return {true};
}

bool ActionParser::above_or_below(std::string_view example) {
    if (reader_.take("below")) return false;
    reader_.want("above", example);
    return true;
}

void ActionParser::motor_stop(Actions& list, Time after) {
    if (reader_.take("none")) return add(list, after, action::FreeMotor{});
    action::StopMotor stop;
    stop.above =
        above_or_below("above or below and a place, such as motor stop below -2 rev, or motor stop none");
    stop.counts = conditions_.place();
    if (reader_.take("spring")) stop.torque_per_count = spring() / conditions_.counts_per_revolution();
    add(list, after, stop);
}

double ActionParser::spring() {
    const double torque = reader_.number("a torque, such as spring 2000 per rev");
    reader_.want("per", "per rev, such as spring 2000 per rev");
    reader_.want("rev", "per rev, such as spring 2000 per rev");
    if (torque < 1 || torque > 1e6) {
        throw LineMistake{"a spring is 1 to 1000000 per rev, 1023 being the motor's full torque"};
    }
    return torque;
}

action::MotorSensor ActionParser::motor_sensor() {
    constexpr std::string_view kExample =
        "motor sensor on below -1 rev, or motor sensor off above 500 counts";
    const bool off = reader_.take("off");
    if (!off) reader_.want("on", kExample);
    const bool above = above_or_below(kExample);
    return {.on_above = above != off, .counts = conditions_.place()};
}

action::MotorAnalogue ActionParser::motor_analogue() {
    const double volts = reader_.number("a voltage, such as motor analogue 7.5 V");
    reader_.want("V", "its unit, such as motor analogue 7.5 V");
    if (volts < -10 || volts > 10) throw LineMistake{"the analogue input takes -10 V to 10 V"};
    return {volts};
}

action::MotorPulses ActionParser::motor_pulses(bool with_direction) {
    const std::string example = with_direction ? "motor steps 5000 per s" : "motor pulses 5000 per s";
    const int rate =
        whole("a rate, such as " + example, -1e6, 1e6, "pulses are a whole number -1000000 to 1000000 per s");
    reader_.want("per", "per s, such as " + example);
    reader_.want("s", "per s, such as " + example);
    return {rate, with_direction};
}

action::MotorSupply ActionParser::motor_supply(bool logic) {
    const std::string example = logic ? "motor logic 15 V" : "motor supply 20 V";
    const double volts = reader_.number("a voltage, such as " + example);
    reader_.want("V", "its unit, such as " + example);
    if (volts < 0 || volts > 600) throw LineMistake{"a supply is 0 V to 600 V"};
    return {volts, logic};
}

action::MotorTemperature ActionParser::motor_temperature() {
    return {whole("degrees Celsius, such as motor temperature 90", -40, 200,
                  "a temperature is a whole number -40 to 200, in degrees Celsius")};
}

}  // namespace nplc::sim
