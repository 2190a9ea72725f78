#include "sim/current_regulator.h"

namespace nplc::sim {

void CurrentRegulator::reset() {
    apply({});
    wanted_ = measured_ = {};
    at_the_end_ = false;
}

void CurrentRegulator::apply(const PerPhase<std::int32_t>& voltage) {
    voltage_ = Phases(voltage).within(kRange);
    wanted_ = {};
    measured_before_ = error_before_ = output_ = output_before_ = {};
    i_nom_ = phi_ = 0;
}

CurrentRegulator::Settings current_settings(const MotorMemory& memory) {
    const bool big = is_mac800(memory.model());
    const double if_one = big ? 65536 : 4096;
    const double ib_one = big ? 16777216 : 256;
    CurrentRegulator::Settings s;
    s.kifx2 = Phases(memory.get(cell::KIFX2) / if_one);
    s.kifx1 = Phases(memory.get(cell::KIFX1) / if_one);
    s.kify1 = Phases(memory.get(cell::KIFY1) / if_one);
    s.kify0 = Phases(memory.get(cell::KIFY0) / if_one);
    s.kib1 = Phases(memory.get(cell::KIB1) / ib_one);
    s.kib0 = Phases(memory.get(cell::KIB0) / ib_one);
    s.amplitude = memory.get(cell::AMPLITUDE) / 256.0;
    s.phase_comp_256 = memory.get(cell::PHASE_COMP);
    s.third_is_rest = big;
    const int measured = big ? 2 : 3;
    PerPhase<double> gain{1, 1, 1};
    PerPhase<double> offset{};
    for (int p = 0; p < measured; ++p) {
        gain[static_cast<std::size_t>(p)] = memory.get(cell::KIA[p]) / 256.0;
        offset[static_cast<std::size_t>(p)] = memory.get(cell::IA_OFFSET[p]) & 0xFFFF;
    }
    s.gain = Phases(gain);
    s.offset = Phases(offset);
    return s;
}

}  // namespace nplc::sim
