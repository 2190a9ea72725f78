#pragma once

#include <string>

#include "sim/scenario.h"

namespace nplc::sim {

/// What a scenario acts upon.
class Stage {
  public:
    virtual void set_input(unsigned index, bool level) = 0;
    virtual void toggle_input(unsigned index) = 0;
    virtual void cut_line(bool cut) = 0;
    virtual void spoil_line(const action::SpoilLine& faults) = 0;
    virtual void seed(std::uint64_t value) = 0;
    virtual void fail_motor() = 0;
    virtual void load_motor(int torque) = 0;
    virtual void set_brake(int torque) = 0;
    virtual void power_motor(bool on) = 0;
    virtual void stop_motor(const action::StopMotor& stop) = 0;
    virtual void free_motor() = 0;
    virtual void connect_sensor(const action::MotorSensor& sensor) = 0;
    virtual void set_analogue(double volts) = 0;
    virtual void set_pulses(const action::MotorPulses& pulses) = 0;
    virtual void set_supply(const action::MotorSupply& supply) = 0;
    virtual void set_temperature(int celsius) = 0;
    virtual void break_encoder() = 0;
    virtual void gateway(action::Gateway what) = 0;
    virtual void log(const std::string& text) = 0;

  protected:
    ~Stage() = default;
};

}  // namespace nplc::sim
