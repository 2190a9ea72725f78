#include "sim/without_effect.h"

#include <fmt/format.h>

#include "sim/mode_table.h"
#include "sim/motor_inputs.h"
#include "supply_notes.h"

namespace nplc::sim {
namespace {

std::string mode_of(const MacMotor& motor) {
    const ModeFacts* facts = facts_of(motor.mode());
    return facts != nullptr ? std::string(facts->name) : fmt::format("mode {}", motor.mode());
}

/// In the order in which a person finds the causes: the supply, the pins, the filter, the form, the mode.
std::string pulses_note(const MacMotor& motor, const action::MotorPulses& pulses) {
    if (pulses.per_second == 0) return {};
    const bool big = is_mac800(motor.model());
    PulseInput input;  // as the motor has taken it over at its start
    input.configure(motor.model(), motor.stored().get(cell::CNTRL_BITS), motor.stored().get(cell::HW_SETUP));
    if (!input.on())
        return "FastMAC has the pins of the pulse input (CNTRL_BITS, USERINTF = 11): write 00 there and "
               "store it "
               "(54h, 56h), the motor then starts with it";
    const auto format = pulses.with_direction ? PulseFormat::pulse_and_direction : PulseFormat::quadrature;
    if (input.filters(format, pulses.per_second))
        return fmt::format("a filter takes more than {} per s; {}",
                           pulses.with_direction ? "31,000" : "124,000",
                           big ? "set NOFILT of HW_SETUP" : "set HICLK of CNTRL_BITS");
    if (input.quarters(format, pulses.per_second) == 0)
        return fmt::format(
            "steps with a direction count back and forth at an input for quadrature; set {}, or "
            "write motor pulses",
            big ? "XPRINP of HW_SETUP" : "PULSEDIR of CNTRL_BITS");
    const ModeFacts* facts = facts_of(motor.mode());
    if (facts != nullptr && facts->geared()) {
        if (motor.read(registers::GEARF1) != 0) return {};
        return "GEARF1 is 0: the shaft does not follow";
    }
    return fmt::format(
        "the shaft does not follow in {}, {}; set a gear mode, such as GP_MODE", mode_of(motor),
        facts != nullptr && facts->counts_pulses ? "V_EXT counts them" : "and V_EXT does not count");
}

std::string brake_note(const MacMotor& motor) {
    if (motor.brake_output()) return {};
    constexpr std::int32_t kManNoBrake = 0x80;
    if ((motor.read(registers::CNTRL_BITS) & kManNoBrake) != 0)
        return "MAN_NO_BRAKE of CNTRL_BITS keeps the brake open";
    return fmt::format("the brake is open while the motor is in {}", mode_of(motor));
}

struct OfMac : SupplyNotes {
    const MacMotor& motor;

    using SupplyNotes::operator();
    std::string operator()(const action::MotorPulses& pulses) const {
        return powered ? pulses_note(motor, pulses) : needs_power();
    }
    std::string operator()(const action::MotorBrake& brake) const {
        return powered && brake.torque != 0 ? brake_note(motor) : std::string();
    }
    std::string operator()(const action::MotorAnalogue&) const { return needs_power(); }
    std::string operator()(const action::FreeMotor&) const {
        const Load& load = motor.plant().load();
        return load.low_stop || load.high_stop ? std::string() : "there is no stop";
    }
    template <class Other>
    std::string operator()(const Other&) const {
        return {};
    }
};

struct NameOf {
    std::string_view operator()(const action::FailMotor&) const { return "motor error"; }
    std::string_view operator()(const action::PowerMotor& power) const {
        return power.on ? "motor power on" : "motor power off";
    }
    std::string_view operator()(const action::BreakEncoder&) const { return "motor encoder broken"; }
    std::string_view operator()(const action::MotorPulses& pulses) const {
        return pulses.with_direction ? "motor steps" : "motor pulses";
    }
    std::string_view operator()(const action::MotorBrake&) const { return "motor brake"; }
    std::string_view operator()(const action::MotorSupply&) const { return "motor supply"; }
    std::string_view operator()(const action::MotorTemperature&) const { return "motor temperature"; }
    std::string_view operator()(const action::MotorAnalogue&) const { return "motor analogue"; }
    std::string_view operator()(const action::FreeMotor&) const { return "motor stop none"; }
    std::string_view operator()(const action::SetDriveInput& input) const { return name_of(input.input); }
    std::string_view operator()(const action::DriveSwitch& connected) const {
        return name_of(connected.input);
    }
    template <class Other>
    std::string_view operator()(const Other&) const {
        return "motor";
    }

  private:
    static std::string_view name_of(action::DriveInput input) {
        switch (input) {
            case action::DriveInput::upper_stop:
                return "motor upper_stop";
            case action::DriveInput::lower_stop:
                return "motor lower_stop";
            case action::DriveInput::reference:
                return "motor reference";
            case action::DriveInput::security:
                return "motor security";
        }
        return "motor";
    }
};

}  // namespace

std::string_view name_of(const Action& action) {
    return std::visit(NameOf{}, action.what);
}

std::string without_effect(const MacMotor& motor, bool powered, const Action& action) {
    return std::visit(OfMac{{powered}, motor}, action.what);
}

}  // namespace nplc::sim
