#include <algorithm>
#include <string>

#include "sim/motor_stage.h"
#include "sim/world.h"

namespace nplc::sim {

void World::set_input(unsigned index, bool level) {
    board_.set_input(index, level);
    wake();
}

void World::toggle_input(unsigned index) {
    set_input(index, (board_.inputs() >> index & 1) == 0);
}

void World::cut_line(bool cut) {
    if (drive_) return drive_->cut(cut);
    if (cut) {
        line_.cut();
    } else {
        line_.restore();
    }
}

void World::spoil_line(const action::SpoilLine& faults) {
    if (drive_) return drive_->spoil(faults);
    if (faults.to_motor) spoil(line_.to_motor(), faults);
    if (faults.from_motor) spoil(line_.from_motor(), faults);
}

void World::power_motor(bool on) {
    if (drive_) return drive_->power(on);
    if (on && !motor_powered_) {
        switch_on(mac_);
        motor_asks_ = std::max(now_, line_.from_motor().busy_until());
    }
    motor_powered_ = on;
}

void World::stop_motor(const action::StopMotor& stop) {
    if (!drive_) return act(mac_, stop);
    if (!drive_->stop(stop)) drive_has_no("a mechanical stop of that kind");
}

void World::free_motor() {
    if (drive_) return drive_->free();
    act(mac_, action::FreeMotor{});
}

void World::connect_sensor(const action::MotorSensor& sensor) {
    if (drive_) return drive_has_no("a home sensor");
    act(mac_, sensor);
}

void World::set_drive_input(const action::SetDriveInput& input) {
    if (drive_ && !drive_->set_input(input)) drive_has_no("an input of that kind");
}

void World::connect_switch(const action::DriveSwitch& connected) {
    if (drive_ && !drive_->connect(connected)) drive_has_no("an input of that kind");
}

void World::set_analogue(double volts) {
    if (drive_) return drive_has_no("an analogue input");
    act(mac_, action::MotorAnalogue{volts});
}

void World::set_pulses(const action::MotorPulses& pulses) {
    if (drive_) return drive_has_no("a pulse input");
    act(mac_, pulses);
}

void World::set_supply(const action::MotorSupply& supply) {
    if (!drive_) return act(mac_, supply);
    if (!drive_->set_supply(supply.volts)) drive_has_no("a supply that can be set");
}

void World::seed(std::uint64_t value) {
    line_.reseed(value);
    if (drive_) drive_->reseed(value);
}

void World::load_motor(int torque) {
    if (!drive_) return act(mac_, action::LoadMotor{torque});
    if (!drive_->load(torque)) drive_has_no("a load");
}

void World::set_brake(int torque) {
    if (drive_) return drive_has_no("a brake");
    act(mac_, action::MotorBrake{torque});
}

void World::set_temperature(int celsius) {
    if (!drive_) return act(mac_, action::MotorTemperature{celsius});
    if (!drive_->set_temperature(celsius)) drive_has_no("a temperature");
}

void World::break_encoder() {
    if (!drive_) return act(mac_, action::BreakEncoder{});
    if (!drive_->break_encoder()) drive_has_no("an encoder that can break");
}

/// The scenario goes on, and says so.
void World::drive_has_no(const char* what) {
    log("the virtual " + std::string(options_.drive->model->family->name()) + " drive does not have " + what);
}

void World::gateway(action::Gateway what) {
    wake();
    switch (what) {
        case action::Gateway::stop:
            controller_->sequence().stop(instant());
            follow_orders();
            return;
        case action::Gateway::run:
            static_cast<void>(controller_->sequence().run());
            return;
        case action::Gateway::restart:
            start_gateway(gateway::StartCause::power_up);
            return;
    }
}

std::string World::motor_note() const {
    return drive_ ? drive_->note(driver_) : std::string(mac_.note());
}

void World::log(const std::string& text) {
    if (on_log_) on_log_(text);
}

}  // namespace nplc::sim
