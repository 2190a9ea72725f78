#include "sim/virtual_drive.h"

#include <array>

#include "registers/family_list.h"

namespace nplc::sim {

#define NPLC_DECLARE(family) \
    std::unique_ptr<VirtualDrive> make_##family##_drive(const VirtualDriveOptions&, const LineFaults&);
NPLC_FAMILIES(NPLC_DECLARE)
#undef NPLC_DECLARE

/// The JVL motor is World's own.
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

void spoil(LineDirection& direction, const action::SpoilLine& what) {
    LineFaults faults = direction.faults();
    faults.drop = what.drop.value_or(faults.drop);
    faults.damage = what.damage.value_or(faults.damage);
    faults.framing = what.framing.value_or(faults.framing);
    faults.delay = what.delay.value_or(faults.delay);
    faults.longest_delay = what.longest_delay.value_or(faults.longest_delay);
    direction.set_faults(faults);
}

}  // namespace nplc::sim
