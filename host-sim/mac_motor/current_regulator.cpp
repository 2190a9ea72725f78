#include "sim/current_regulator.h"

namespace nplc::sim {

void CurrentRegulator::reset() {
    apply({});
    wanted_ = measured_ = {};
    at_the_end_ = false;
}

void CurrentRegulator::apply(const PerPhase<std::int32_t>& voltage) {
    for (std::size_t p = 0; p < kPhases; ++p) voltage_[p] = std::clamp(voltage[p], -kRange, kRange);
    wanted_ = {};
    measured_before_ = error_before_ = output_ = output_before_ = {};
    i_nom_ = phi_ = 0;
}

CurrentRegulator::Settings current_settings(const MotorMemory& memory) {
    const bool big = is_mac800(memory.model());
    const double if_one = big ? 65536 : 4096;
    const double ib_one = big ? 16777216 : 256;
    CurrentRegulator::Settings s;
    s.kifx2 = memory.get(cell::KIFX2) / if_one;
    s.kifx1 = memory.get(cell::KIFX1) / if_one;
    s.kify1 = memory.get(cell::KIFY1) / if_one;
    s.kify0 = memory.get(cell::KIFY0) / if_one;
    s.kib1 = memory.get(cell::KIB1) / ib_one;
    s.kib0 = memory.get(cell::KIB0) / ib_one;
    s.amplitude = memory.get(cell::AMPLITUDE) / 256.0;
    s.phase_comp = memory.get(cell::PHASE_COMP) / 256.0;
    s.third_is_rest = big;
    const int measured = big ? 2 : 3;
    for (int p = 0; p < measured; ++p) {
        s.gain[static_cast<std::size_t>(p)] = memory.get(cell::KIA[p]) / 256.0;
        s.offset[static_cast<std::size_t>(p)] = memory.get(cell::IA_OFFSET[p]) & 0xFFFF;
    }
    return s;
}

}  // namespace nplc::sim
