#include "sim/virtual_drive.h"

#include <fmt/format.h>

#include <array>

#include "registers/family_list.h"

namespace nplc::sim {

#define NPLC_DECLARE(family) \
    std::unique_ptr<VirtualDrive> make_##family##_drive(const VirtualDriveOptions&, const LineFaults&);
NPLC_FAMILIES(NPLC_DECLARE)
#undef NPLC_DECLARE

/// The JVL motor is part of World.
std::unique_ptr<VirtualDrive> make_jvl_drive(const VirtualDriveOptions&, const LineFaults&) {
    return nullptr;
}

std::unique_ptr<VirtualDrive> make_virtual_drive(const VirtualDriveOptions& options,
                                                 const LineFaults& faults) {
#define NPLC_ADDRESS(family) &make_##family##_drive,
    constexpr std::array kMakes{NPLC_FAMILIES(NPLC_ADDRESS)};  // in the order of registers::families()
#undef NPLC_ADDRESS
    for (std::size_t i = 0; i < kMakes.size(); ++i) {
        if (registers::families()[i] == options.model->family) return kMakes[i](options, faults);
    }
    return nullptr;
}

namespace {

struct MissingPart {
    std::string_view operator()(const action::LoadMotor&) const { return "a load"; }
    std::string_view operator()(const action::MotorBrake&) const { return "a brake"; }
    std::string_view operator()(const action::StopMotor&) const { return "a mechanical stop of that kind"; }
    std::string_view operator()(const action::FreeMotor&) const { return {}; }
    std::string_view operator()(const action::MotorSensor&) const { return "a home sensor"; }
    std::string_view operator()(const action::SetDriveInput&) const { return "an input of that kind"; }
    std::string_view operator()(const action::DriveSwitch&) const { return "an input of that kind"; }
    std::string_view operator()(const action::MotorAnalogue&) const { return "an analogue input"; }
    std::string_view operator()(const action::MotorPulses&) const { return "a pulse input"; }
    std::string_view operator()(const action::MotorSupply&) const { return "a supply that can be set"; }
    std::string_view operator()(const action::MotorTemperature&) const { return "a temperature"; }
    std::string_view operator()(const action::BreakEncoder&) const { return "an encoder that can break"; }
};

}  // namespace

std::string_view missing_for(const action::OnMotor& what) {
    return std::visit(MissingPart{}, what);
}

std::string lacks(const registers::DriveModel& model, std::string_view part) {
    return fmt::format("the virtual {} drive does not have {}", model.family->name(), part);
}

void spoil(LineDirection& direction, const action::SpoilLine& what) {
    LineFaults faults = direction.faults();
    faults.drop = what.drop.value_or(faults.drop);
    faults.damage = what.damage.value_or(faults.damage);
    faults.framing = what.framing.value_or(faults.framing);
    faults.delay = what.delay.value_or(faults.delay);
    faults.longest_delay = what.longest_delay.value_or(faults.longest_delay);
    faults.late = what.late.value_or(faults.late);
    faults.together = what.together.value_or(faults.together);
    direction.set_faults(faults);
}

}  // namespace nplc::sim
