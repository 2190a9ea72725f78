#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace nplc::registers {

/// Register numbers of MAC50/95/140/141 (001 §3.2) used in the firmware and its tools. 1..88 also apply to
/// the MAC800.
enum Number : std::uint8_t {
    PROG_VERSION = 1,
    MODE_REG = 2,
    P_SOLL = 3,
    V_SOLL = 5,
    A_SOLL = 6,
    T_SOLL = 7,
    P_FNC = 8,
    P_IST = 10,
    V_IST = 12,
    KVOUT = 13,
    GEARF1 = 14,
    GEARF2 = 15,
    I2T = 16,
    I2TLIM = 17,
    UIT = 18,
    UITLIM = 19,
    FLWERR = 20,
    FLWERRMAX = 22,
    FNCERR = 24,
    FNCERRMAX = 26,
    MIN_P_IST = 28,
    MAX_P_IST = 30,
    ACC_EMERG = 32,
    INPOSWIN = 33,
    INPOSCNT = 34,
    ERR_STAT = 35,
    CNTRL_BITS = 36,
    STARTMODE = 37,
    P_HOME = 38,
    V_HOME = 40,
    T_HOME = 41,
    HOME_MODE = 42,
    P_REG_P = 43,
    V_REG_P = 44,
    A_REG_P = 45,
    T_REG_P = 46,
    L_REG_P = 47,
    Z_REG_P = 48,
    P1 = 49,
    V1 = 65,
    A1 = 73,
    T1 = 77,
    L1 = 81,
    Z1 = 85,
    FNC_OUT = 117,
    V_EXT = 120,
    VF_OUT = 121,
    ANINP = 122,
};

enum class Format : std::uint8_t { word, integer, long_int, fixed4, fixed8, fixed16, fixed24 };

/// The quantity of a register; `none` for modes, pointers and plain numbers. Factors: registers/scale.h.
enum class Unit : std::uint8_t {
    none,
    bits,             ///< named in registers/details.h
    counts,           ///< encoder counts
    counts_16,        ///< 1/16 encoder counts
    velocity_16,      ///< 1/16 counts/sample
    velocity,         ///< counts/sample
    acceleration_16,  ///< 1/16 counts/sample^2
    torque,           ///< 1023 = full torque
    samples,
    velocity_inner,    ///< counts/sample of the current loop
    analogue_volts,    ///< at the analogue input
    supply_volts,      ///< of the motor, MAC50-141
    logic_volts,       ///< of the control, MAC800
    bus_volts,         ///< inside the motor, MAC800
    temperature,       ///< MAC800
    electrical_angle,  ///< 2048 = one electrical period
};

enum class Access : std::uint8_t {
    read_write,
    motor_writes,  ///< may be written, and is also written by the motor
    read_only,     ///< overwritten by the motor, or informative only
};

enum class Model : std::uint8_t { mac50, mac95, mac140, mac141, mac800 };

/// Encoder and sample rate, for converting counts and samples to revolutions and seconds.
struct Scale {
    std::int32_t counts_per_rev;
    double samples_per_second;
};

struct Register {
    std::uint8_t number;
    std::string_view name;  ///< as in the manual
    Format format;
    Unit unit;
    std::int64_t min;  ///< raw, as written to the line
    std::int64_t max;
    bool dangerous;  ///< a change may damage the motor or disturb its control
    Access access;
    std::string_view section;  ///< of the manual
};

constexpr bool is_32_bit(Format format) {
    return format == Format::long_int || format == Format::fixed16 || format == Format::fixed24;
}

/// The map of a model, in ascending order of number. At least registers 1..127.
std::span<const Register> map_of(Model model);
const Register* find(Model model, std::uint8_t number);
/// Case-insensitive. On a MAC800 the names of 001 §3.2 are found too, up to register 88 (P1 is its POS0).
const Register* find(Model model, std::string_view name);
Scale scale_of(Model model);
std::optional<Model> model_of(std::string_view name);
std::string_view name_of(Model model);

}  // namespace nplc::registers
