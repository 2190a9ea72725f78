#include "sim/motor_memory.h"

namespace nplc::sim {
namespace {

// Velocities: V_SOLL 762.9 rpm on MAC50-141 (001 §3.2.5), 1000 rpm on MAC800 (004); Vn is n x 190.7 rpm or n
// x 200 rpm. Accelerations: 39,731 rpm/s on MAC50-141 (001 §3.2.6), 100,000 rpm/s on MAC800 (004); An halves
// or doubles it.
struct Defaults {
    std::int32_t prog_version, v_soll, v_step, a_soll, a_first, kvout_one;
};
constexpr Defaults kSmall{78, 1600, 400, 160, 40, 0x100};
constexpr Defaults kBig{0x8000 | 78, 2771, 554, 360, 90, 0x10000};

// The smallest that holds in velocity mode too, where V_IST steps by 16 of V_SOLL's units and may be a count
// off.
constexpr std::int32_t kInPosWindow = 32;
constexpr std::int32_t kInPosCount = 3;
constexpr std::int32_t kUserInterfaceFastMac = 3;

}  // namespace

void write_defaults(MotorMemory& memory, std::uint8_t address) {
    const Defaults& d = is_mac800(memory.model()) ? kBig : kSmall;
    memory.set(cell::PROG_VERSION, d.prog_version);
    memory.set(cell::V_SOLL, d.v_soll);
    memory.set(cell::A_SOLL, d.a_soll);
    memory.set(cell::T_SOLL, 1023);
    memory.set(cell::KVOUT, d.kvout_one);
    memory.set(cell::GEARF1, 1);
    memory.set(cell::GEARF2, 1);
    memory.set(cell::I2TLIM, 10000);
    memory.set(cell::UITLIM, 10000);
    memory.set(cell::INPOSWIN, kInPosWindow);
    memory.set(cell::INPOSCNT, kInPosCount);
    if (!is_mac800(memory.model())) memory.set(cell::CNTRL_BITS, kUserInterfaceFastMac);
    memory.set(cell::V_HOME, -d.v_step);
    memory.set(cell::T_HOME, 300);
    memory.set(cell::MYADDR, address);
    for (int n = 0; n < 8; ++n) memory.set(cell::V1[n], d.v_step * (n + 1));
    for (int n = 0; n < 4; ++n) {
        memory.set(cell::A1[n], d.a_first << n);
        memory.set(cell::T1[n], 1023);
        memory.set(cell::L1[n], d.kvout_one);
        memory.set(cell::Z1[n], kInPosWindow);
    }
}

}  // namespace nplc::sim
