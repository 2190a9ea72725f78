#include "sim/without_effect.h"
#include "supply_notes.h"

namespace nplc::sim {
namespace {

std::string input_note(const MidiModule& module, action::DriveInput input) {
    switch (input) {
        case action::DriveInput::upper_stop:
        case action::DriveInput::lower_stop:
            if ((module.memory().stops & MidiMemory::kHardwareStops) != 0) return {};
            return "the stop inputs are not enabled (03h, END_STOPS 1)";
        case action::DriveInput::reference:
            if (module.reference_enabled()) return {};
            return "the reference input is not enabled (07h, REFERENCE 1)";
        case action::DriveInput::security:
            return {};
    }
    return {};
}

struct OfModule : SupplyNotes {
    const MidiModule& module;

    using SupplyNotes::operator();
    std::string operator()(const action::Cancel&) const {
        return "it drops what a scenario's rules have planned, and a module here has none";
    }
    std::string operator()(const action::SetDriveInput& input) const {
        if (!powered) return needs_power();
        return input.active ? input_note(module, input.input) : std::string();
    }
    std::string operator()(const action::DriveSwitch& connected) const {
        return powered ? input_note(module, connected.input) : needs_power();
    }
    template <class Other>
    std::string operator()(const Other&) const {
        return {};
    }
};

}  // namespace

std::string without_effect(const MidiModule& module, bool powered, const Action& action) {
    return std::visit(OfModule{{powered}, module}, action.what);
}

}  // namespace nplc::sim
