// Registers of MAC50, MAC95, MAC140 and MAC141 (001 §3.2). Where the manual only recommends a range, the
// limits are those of the format.
#include <array>

#include "registers/layout.h"
#include "tables.h"

namespace nplc::registers {
namespace {

constexpr std::int64_t kLong = 2'147'483'647;
constexpr bool kOrdinary = false;
constexpr bool kDangerous = true;
constexpr Format W = Format::word;
constexpr Format I = Format::integer;
constexpr Format L = Format::long_int;
constexpr Format F4 = Format::fixed4;
constexpr Format F8 = Format::fixed8;
constexpr Access RW = Access::read_write;
constexpr Access MW = Access::motor_writes;
constexpr Access RO = Access::read_only;
using enum Unit;

// clang-format off
constexpr Register kSmall[] = {
    {1, "PROG_VERSION", W, none, 0, 65535, kOrdinary, RO, "001 §3.2.1"},
    {2, "MODE_REG", W, none, 0, 258, kOrdinary, MW, "001 §3.2.2"},
    {3, "P_SOLL", L, counts, -67000000, 67000000, kOrdinary, MW, "001 §3.2.3"},
    {5, "V_SOLL", I, velocity_16, -32767, 32767, kOrdinary, MW, "001 §3.2.5"},
    {6, "A_SOLL", W, acceleration_16, 0, 65535, kOrdinary, MW, "001 §3.2.6"},
    {7, "T_SOLL", W, torque, 0, 1023, kOrdinary, MW, "001 §3.2.7"},
    {8, "P_FNC", L, counts_16, -kLong, kLong, kOrdinary, MW, "001 §3.2.8"},
    {10, "P_IST", L, counts, -kLong, kLong, kOrdinary, MW, "001 §3.2.10"},
    {12, "V_IST", I, velocity, -32767, 32767, kDangerous, RO, "001 §3.2.12"},
    {13, "KVOUT", F8, none, -32767, 32767, kOrdinary, MW, "001 §3.2.13"},
    {14, "GEARF1", I, none, -32767, 32767, kOrdinary, RW, "001 §3.2.14"},
    {15, "GEARF2", W, none, 0, 65535, kOrdinary, RW, "001 §3.2.15"},
    {16, "I2T", W, none, 0, 65535, kDangerous, RO, "001 §3.2.16"},
    {17, "I2TLIM", W, none, 0, 65535, kDangerous, RW, "001 §3.2.17"},
    {18, "UIT", W, none, 0, 65535, kDangerous, RO, "001 §3.2.18"},
    {19, "UITLIM", W, none, 0, 65535, kDangerous, RW, "001 §3.2.19"},
    {20, "FLWERR", L, counts, -67000000, 67000000, kOrdinary, RO, "001 §3.2.20"},
    {22, "FLWERRMAX", L, counts, 0, 67000000, kOrdinary, RW, "001 §3.2.22"},
    {24, "FNCERR", L, none, -134217727, 134217727, kOrdinary, RO, "001 §3.2.24"},
    {26, "FNCERRMAX", L, none, 0, 134217727, kOrdinary, RW, "001 §3.2.26"},
    {28, "MIN_P_IST", L, counts, -kLong, kLong, kOrdinary, RW, "001 §3.2.28"},
    {30, "MAX_P_IST", L, counts, -kLong, kLong, kOrdinary, RW, "001 §3.2.30"},
    {32, "ACC_EMERG", W, acceleration_16, 0, 65535, kOrdinary, RW, "001 §3.2.32"},
    {33, "INPOSWIN", W, counts, 0, 32767, kOrdinary, MW, "001 §3.2.33"},
    {34, "INPOSCNT", W, samples, 0, 32767, kOrdinary, RW, "001 §3.2.34"},
    {35, "ERR_STAT", W, bits, 0, 65535, kOrdinary, MW, "001 §3.2.35"},
    {36, "CNTRL_BITS", W, bits, 0, 65535, kOrdinary, MW, "001 §3.2.36"},
    {37, "STARTMODE", W, none, 0, 65535, kOrdinary, RW, "001 §3.2.37"},
    {38, "P_HOME", L, counts, -67000000, 67000000, kOrdinary, RW, "001 §3.2.38"},
    {40, "V_HOME", I, velocity_16, -32767, 32767, kOrdinary, RW, "001 §3.2.40"},
    {41, "T_HOME", I, torque, -800, 800, kOrdinary, RW, "001 §3.2.41"},
    {42, "HOME_MODE", W, bits, 0, 65535, kOrdinary, RW, "001 §3.2.42"},
    {43, "P_REG_P", W, none, 0, 8, kOrdinary, MW, "001 §3.2.43"},
    {44, "V_REG_P", W, none, 0, 8, kOrdinary, MW, "001 §3.2.44"},
    {45, "A_REG_P", W, none, 0, 4, kOrdinary, MW, "001 §3.2.45"},
    {46, "T_REG_P", W, none, 0, 4, kOrdinary, MW, "001 §3.2.46"},
    {47, "L_REG_P", W, none, 0, 4, kOrdinary, MW, "001 §3.2.47"},
    {48, "Z_REG_P", W, none, 0, 4, kOrdinary, MW, "001 §3.2.48"},
    {49, "P1", L, counts, -67000000, 67000000, kOrdinary, RW, "001 §3.2.49"},
    {51, "P2", L, counts, -67000000, 67000000, kOrdinary, RW, "001 §3.2.51"},
    {53, "P3", L, counts, -67000000, 67000000, kOrdinary, RW, "001 §3.2.53"},
    {55, "P4", L, counts, -67000000, 67000000, kOrdinary, RW, "001 §3.2.55"},
    {57, "P5", L, counts, -67000000, 67000000, kOrdinary, RW, "001 §3.2.57"},
    {59, "P6", L, counts, -67000000, 67000000, kOrdinary, RW, "001 §3.2.59"},
    {61, "P7", L, counts, -67000000, 67000000, kOrdinary, RW, "001 §3.2.61"},
    {63, "P8", L, counts, -67000000, 67000000, kOrdinary, RW, "001 §3.2.63"},
    {65, "V1", I, velocity_16, -32767, 32767, kOrdinary, RW, "001 §3.2.65"},
    {66, "V2", I, velocity_16, -32767, 32767, kOrdinary, RW, "001 §3.2.66"},
    {67, "V3", I, velocity_16, -32767, 32767, kOrdinary, RW, "001 §3.2.67"},
    {68, "V4", I, velocity_16, -32767, 32767, kOrdinary, RW, "001 §3.2.68"},
    {69, "V5", I, velocity_16, -32767, 32767, kOrdinary, RW, "001 §3.2.69"},
    {70, "V6", I, velocity_16, -32767, 32767, kOrdinary, RW, "001 §3.2.70"},
    {71, "V7", I, velocity_16, -32767, 32767, kOrdinary, RW, "001 §3.2.71"},
    {72, "V8", I, velocity_16, -32767, 32767, kOrdinary, RW, "001 §3.2.72"},
    {73, "A1", W, acceleration_16, 0, 65535, kOrdinary, RW, "001 §3.2.73"},
    {74, "A2", W, acceleration_16, 0, 65535, kOrdinary, RW, "001 §3.2.74"},
    {75, "A3", W, acceleration_16, 0, 65535, kOrdinary, RW, "001 §3.2.75"},
    {76, "A4", W, acceleration_16, 0, 65535, kOrdinary, RW, "001 §3.2.76"},
    {77, "T1", W, torque, 0, 1023, kOrdinary, RW, "001 §3.2.77"},
    {78, "T2", W, torque, 0, 1023, kOrdinary, RW, "001 §3.2.78"},
    {79, "T3", W, torque, 0, 1023, kOrdinary, RW, "001 §3.2.79"},
    {80, "T4", W, torque, 0, 1023, kOrdinary, RW, "001 §3.2.80"},
    {81, "L1", F8, none, -32767, 32767, kOrdinary, RW, "001 §3.2.81"},
    {82, "L2", F8, none, -32767, 32767, kOrdinary, RW, "001 §3.2.82"},
    {83, "L3", F8, none, -32767, 32767, kOrdinary, RW, "001 §3.2.83"},
    {84, "L4", F8, none, -32767, 32767, kOrdinary, RW, "001 §3.2.84"},
    {85, "Z1", W, counts, 0, 32767, kOrdinary, RW, "001 §3.2.85"},
    {86, "Z2", W, counts, 0, 32767, kOrdinary, RW, "001 §3.2.86"},
    {87, "Z3", W, counts, 0, 32767, kOrdinary, RW, "001 §3.2.87"},
    {88, "Z4", W, counts, 0, 32767, kOrdinary, RW, "001 §3.2.88"},
    {89, "KFF3", F8, none, -32767, 32767, kDangerous, RW, "001 §3.2.89"},
    {90, "KFF2", F8, none, -32767, 32767, kDangerous, RW, "001 §3.2.90"},
    {91, "KFF1", F8, none, -32767, 32767, kDangerous, RW, "001 §3.2.91"},
    {92, "KFF0", F8, none, -32767, 32767, kDangerous, RW, "001 §3.2.92"},
    {93, "KVFX4", F4, none, -32767, 32767, kDangerous, RW, "001 §3.2.93"},
    {94, "KVFX3", F4, none, -32767, 32767, kDangerous, RW, "001 §3.2.94"},
    {95, "KVFX2", F4, none, -32767, 32767, kDangerous, RW, "001 §3.2.95"},
    {96, "KVFX1", F4, none, -32767, 32767, kDangerous, RW, "001 §3.2.96"},
    {97, "KVFY3", F4, none, -32767, 32767, kDangerous, RW, "001 §3.2.97"},
    {98, "KVFY2", F4, none, -32767, 32767, kDangerous, RW, "001 §3.2.98"},
    {99, "KVFY1", F4, none, -32767, 32767, kDangerous, RW, "001 §3.2.99"},
    {100, "KVFY0", F4, none, -32767, 32767, kDangerous, RW, "001 §3.2.100"},
    {101, "GEARB", F8, none, -32767, 32767, kDangerous, RW, "001 §3.2.101"},
    {102, "KVB3", F8, none, -32767, 32767, kDangerous, RW, "001 §3.2.102"},
    {103, "KVB2", F8, none, -32767, 32767, kDangerous, RW, "001 §3.2.103"},
    {104, "KVB1", F8, none, -32767, 32767, kDangerous, RW, "001 §3.2.104"},
    {105, "KVB0", F8, none, -32767, 32767, kDangerous, RW, "001 §3.2.105"},
    {106, "KIFX2", F4, none, -32767, 32767, kDangerous, RW, "001 §3.2.106"},
    {107, "KIFX1", F4, none, -32767, 32767, kDangerous, RW, "001 §3.2.107"},
    {108, "KIFY1", F4, none, -32767, 32767, kDangerous, RW, "001 §3.2.108"},
    {109, "KIFY0", F4, none, -32767, 32767, kDangerous, RW, "001 §3.2.109"},
    {110, "KIB1", F8, none, -32767, 32767, kDangerous, RW, "001 §3.2.110"},
    {111, "KIB0", F8, none, -32767, 32767, kDangerous, RW, "001 §3.2.111"},
    {112, "SAMPLE1", W, none, 1, 164, kOrdinary, MW, "001 §3.2.112"},
    {113, "SAMPLE2", W, none, 1, 164, kOrdinary, MW, "001 §3.2.113"},
    {114, "SAMPLE3", W, none, 1, 164, kOrdinary, RW, "001 §3.2.114"},
    {115, "SAMPLE4", W, none, 1, 164, kOrdinary, RW, "001 §3.2.115"},
    {116, "REC_CNT", W, none, 0, 895, kOrdinary, MW, "001 §3.2.116"},
    {117, "FNC_OUT", I, velocity_16, -32767, 32767, kDangerous, RO, "001 §3.2.117"},
    {118, "FF_OUT", I, none, -32767, 32767, kDangerous, RO, "001 §3.2.118"},
    {119, "VB_OUT", I, none, -32767, 32767, kDangerous, RO, "001 §3.2.119"},
    {120, "V_EXT", I, velocity, -32767, 32767, kOrdinary, RO, "001 §3.2.120"},
    {121, "VF_OUT", I, torque, -1023, 1023, kDangerous, RO, "001 §3.2.121"},
    {122, "ANINP", I, analogue_volts, -32767, 32767, kOrdinary, RO, "001 §3.2.122"},
    {123, "ANINP_OFFSET", I, analogue_volts, -32767, 32767, kOrdinary, RW, "001 §3.2.123"},
    {124, "ELDEGN_OFFSET", W, electrical_angle, 0, 2047, kDangerous, RW, "001 §3.2.124"},
    {125, "ELDEGP_OFFSET", W, electrical_angle, 0, 2047, kDangerous, RW, "001 §3.2.125"},
    {126, "PHASE_COMP", F8, none, -32767, 32767, kDangerous, RW, "001 §3.2.126"},
    {127, "AMPLITUDE", F8, none, 0, 212, kDangerous, RW, "001 §3.2.127"},
    {128, "MAN_I_NOM", W, none, 0, 1023, kDangerous, RW, "001 §3.2.128"},
    {129, "MAN_ALPHA", W, electrical_angle, 0, 2047, kDangerous, RW, "001 §3.2.129"},
    {130, "UMEAS", W, none, 0, 100, kDangerous, RW, "001 §3.2.130"},
    {131, "I_NOM", W, none, 0, 65535, kDangerous, RO, "001 §3.2.131"},
    {132, "PHI_SOLL", W, none, 0, 65535, kDangerous, RO, "001 §3.2.132"},
    {133, "IA_SOLL", I, none, -850, 850, kDangerous, RO, "001 §3.2.133"},
    {134, "IB_SOLL", I, none, -850, 850, kDangerous, RO, "001 §3.2.134"},
    {135, "IC_SOLL", I, none, -850, 850, kDangerous, RO, "001 §3.2.135"},
    {136, "IX_SELECT", W, none, 0, 65535, kDangerous, RW, "001 §3.2.136"},
    {137, "IA_IST", I, none, -1023, 1023, kDangerous, RO, "001 §3.2.137"},
    {138, "IB_IST", I, none, -1023, 1023, kDangerous, RO, "001 §3.2.138"},
    {139, "IC_IST", I, none, -1023, 1023, kDangerous, RO, "001 §3.2.139"},
    {140, "IA_OFFSET", W, none, 0, 2047, kDangerous, MW, "001 §3.2.140"},
    {141, "IB_OFFSET", W, none, 0, 2047, kDangerous, MW, "001 §3.2.141"},
    {142, "IC_OFFSET", W, none, 0, 2047, kDangerous, MW, "001 §3.2.142"},
    {143, "ELDEG_IST", W, electrical_angle, 0, 2047, kDangerous, RO, "001 §3.2.143"},
    {144, "V_ELDEG", I, velocity_inner, -32767, 32767, kDangerous, RO, "001 §3.2.144"},
    {145, "UA_VAL", I, none, -32767, 32767, kDangerous, RO, "001 §3.2.145"},
    {146, "UB_VAL", I, none, -32767, 32767, kDangerous, RO, "001 §3.2.146"},
    {147, "UC_VAL", I, none, -32767, 32767, kDangerous, RO, "001 §3.2.147"},
    {148, "KIA", W, none, 0, 65535, kDangerous, RW, "001 §3.2.148"},
    {149, "KIB", W, none, 0, 65535, kDangerous, RW, "001 §3.2.149"},
    {150, "KIC", W, none, 0, 65535, kDangerous, RW, "001 §3.2.150"},
    {151, "U_SUPPLY", W, supply_volts, 0, 65535, kDangerous, RO, "001 §3.2.151"},
    {152, "U_MIN_SUP", W, supply_volts, 0, 65535, kDangerous, RW, "001 §3.2.152"},
    {153, "MOTOR_TYPE", W, none, 0, 65535, kDangerous, RO, "001 §3.2.153"},
    {154, "SERIAL_NMB", L, none, -kLong, kLong, kDangerous, RO, "001 §3.2.154"},
    {156, "MYADDR", W, none, 1, 254, kOrdinary, RW, "001 §3.2.156"},
    {157, "HW_VERSION", W, none, 0, 65535, kDangerous, RO, "001 §3.2.157"},
    {158, "CHKSUM", L, none, -kLong, kLong, kDangerous, RO, "001 §3.2.158"},
    {160, "UV_HANDLE", W, bits, 0, 65535, kOrdinary, RW, "001 §3.2.160"},
    {161, "INV_OUTPUT", W, none, 0, 65535, kDangerous, RW, "001 §3.2.161"},
    {162, "INDEX_OFFSET", W, none, 0, 65535, kDangerous, RW, "001 §3.2.162"},
    {163, "P_NEW", L, counts, -kLong, kLong, kOrdinary, RW, "001 §3.2.163"},
};
// clang-format on

using Bits = std::array<std::uint32_t, 8>;

template <class Holds>
constexpr Bits bits_where(const Holds& holds) {
    Bits bits{};
    for (const Register& reg : kSmall) {
        if (holds(reg)) bits[reg.number / 32U] |= 1U << reg.number % 32U;
    }
    return bits;
}

constexpr Bits kLongOnes = bits_where([](const Register& reg) { return is_32_bit(reg.format); });
constexpr Bits kSignedOnes = bits_where([](const Register& reg) { return reg.min < 0; });

constexpr bool has(const Bits& bits, std::uint8_t number) {
    return (bits[number / 32U] >> number % 32U & 1U) != 0;
}

}  // namespace

Width small_width_of(std::uint8_t number) {
    return {static_cast<std::uint8_t>(has(kLongOnes, number) ? 4 : 2), has(kSignedOnes, number)};
}

std::span<const Register> small_map() {
    return kSmall;
}

}  // namespace nplc::registers
