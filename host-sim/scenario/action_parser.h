#pragma once

#include <utility>

#include "condition_parser.h"
#include "sim/scenario.h"
#include "tokens.h"

namespace nplc::sim {

/// What a scenario can do. All functions throw LineMistake.
class ActionParser {
  public:
    ActionParser(Reader& reader, ConditionParser& conditions) : reader_(reader), conditions_(conditions) {}

    /// [after TIME] ACTION {, [after TIME] ACTION}; times add up.
    Actions actions();

  private:
    template <class What>
    static void add(Actions& list, Time after, What what) {
        list.push_back({after, std::move(what)});
    }

    void action(Actions& list, Time after);
    void set_input(Actions& list, Time after);
    void check_known_word();
    void pulse(Actions& list, Time after);
    void line(Actions& list, Time after);
    void line_direction(action::SpoilLine& spoil);
    bool fault(action::SpoilLine& spoil);
    void motor(Actions& list, Time after);
    action::LoadMotor motor_load();
    action::MotorBrake motor_brake();
    action::PowerMotor motor_power();
    void motor_stop(Actions& list, Time after);
    double spring();
    action::MotorSensor motor_sensor();
    action::MotorAnalogue motor_analogue();
    action::MotorPulses motor_pulses(bool with_direction);
    action::MotorSupply motor_supply(bool logic);
    action::MotorTemperature motor_temperature();
    bool above_or_below(std::string_view example);
    int whole(std::string_view what, double least, double most, std::string_view mistake);
    void gateway(Actions& list, Time after);
    void seed(Actions& list, Time after);
    void log(Actions& list, Time after);

    Reader& reader_;
    ConditionParser& conditions_;
};

}  // namespace nplc::sim
