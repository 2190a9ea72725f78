#include "sim/midi_stage.h"

#include <cmath>
#include <utility>

#include "registers/midi.h"
#include "registers/scale.h"
#include "sim/without_effect.h"

namespace nplc::sim {
namespace {

namespace midi = registers::midi;

constexpr std::int32_t kWholeTorque = 1'023;

MidiModule::Input input_of(action::DriveInput input) {
    switch (input) {
        case action::DriveInput::upper_stop:
            return MidiModule::Input::upper_stop;
        case action::DriveInput::lower_stop:
            return MidiModule::Input::lower_stop;
        case action::DriveInput::reference:
            return MidiModule::Input::reference;
        case action::DriveInput::security:
            return MidiModule::Input::security;
    }
    return MidiModule::Input::security;
}

struct ModuleActor {
    MidiModule& module;

    bool operator()(const action::LoadMotor& load) const {
        module.set_load(load.torque * module.imax() / kWholeTorque);
        return true;
    }
    bool operator()(const action::StopMotor& stop) const {
        if (stop.torque_per_count != 0) return false;
        module.stop_shaft(stop.above, increments_of(module.model(), stop.counts));
        return true;
    }
    bool operator()(const action::FreeMotor&) const {
        module.free_shaft();
        return true;
    }
    bool operator()(const action::SetDriveInput& input) const {
        module.set_input(input_of(input.input), input.active);
        return true;
    }
    bool operator()(const action::DriveSwitch& connected) const {
        module.connect(input_of(connected.input), connected.on_above,
                       increments_of(module.model(), connected.counts));
        return true;
    }
    bool operator()(const action::MotorSupply& supply) const {
        module.set_supply(static_cast<std::int32_t>(std::lround(1000 * supply.volts)));
        return true;
    }
    bool operator()(const action::MotorTemperature& temperature) const {
        module.set_temperature(1000 * temperature.celsius);
        return true;
    }
    bool operator()(const action::BreakEncoder&) const {
        module.connect_encoder(false);
        return true;
    }
    bool operator()(const action::MotorBrake&) const { return false; }
    bool operator()(const action::MotorSensor&) const { return false; }
    bool operator()(const action::MotorAnalogue&) const { return false; }
    bool operator()(const action::MotorPulses&) const { return false; }
};

}  // namespace

std::int64_t increments_of(midi::Model model, std::int64_t counts) {
    const registers::Scale scale = registers::scale_of(registers::Model::mac140);
    return counts * midi::facts_of(model).increments_per_rev / scale.counts_per_rev;
}

bool act(MidiModule& module, const action::OnMotor& what) {
    return std::visit(ModuleActor{module}, what);
}

std::string ModuleAlone::also(Actions actions, Time now) {
    std::string why = without_effect(module_, module_.is_on(), actions);
    runner_.also(std::move(actions), now);
    return why;
}

void ModuleAlone::observe(Time now) {
    Snapshot snapshot;
    snapshot.time = now;
    while (runner_.observe(snapshot)) {
    }
}

}  // namespace nplc::sim
