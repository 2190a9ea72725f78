#include "sim/motor_memory.h"

#include "sim/plant.h"

namespace nplc::sim {
namespace {

using Kind = Cell::Kind;

/// For each number of MAC50-141; the second number of a LongInt is unused.
using Kinds = std::array<Kind, 257>;

struct Row {
    Cell first;
    int registers = 1;
};

constexpr Kinds kinds_of_numbers() {
    using namespace cell;
    Kinds kinds{};  // words
    for (const Row& row : std::initializer_list<Row>{
             {P_SOLL},        {V_SOLL},     {P_FNC},     {P_IST},     {V_IST},        {GEARF1},
             {FLWERR},        {FLWERRMAX},  {FNCERR},    {FNCERRMAX}, {MIN_P_IST},    {MAX_P_IST},
             {P_HOME},        {V_HOME},     {T_HOME},    {P1, 8},     {V1, 8},        {KFF, 4},
             {KVFX, 4},       {KVFY, 4},    {GEARB},     {KVB, 4},    {KIFX2},        {KIFX1},
             {KIFY1},         {KIFY0},      {KIB1},      {KIB0},      {FNC_OUT},      {FF_OUT},
             {VB_OUT},        {V_EXT},      {VF_OUT},    {ANINP},     {ANINP_OFFSET}, {PHASE_COMP},
             {AMPLITUDE},     {IA_SOLL, 3}, {IA_IST, 3}, {V_ELDEG},   {UA_VAL, 3},    {P_NEW},
             {SERIAL_NUMBER}, {CHKSUM}}) {
        for (int n = 0; n < row.registers; ++n) kinds[row.first[n].small] = row.first.kind;
    }
    return kinds;
}

constexpr Kinds kKinds = kinds_of_numbers();

bool is_high_word(std::size_t place) {
    return place != 0 && kKinds[place - 1] == Kind::long_int;
}

constexpr std::int32_t with_low(std::int32_t value, std::uint16_t word) {
    return (value & ~0xFFFF) | word;
}

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

/// Fixed-point coefficients; their design is in the folder's README.
struct Filters {
    double one_f, one_vf, one_if;  // what is 1.0 in FF, VB and IB; in VF; in IF
};
constexpr Filters kSmallFilters{256, 4096, 4096};
constexpr Filters kBigFilters{16777216, 65536, 65536};

std::int32_t fixed(double value, double one) {
    return static_cast<std::int32_t>(value * one + (value < 0 ? -0.5 : 0.5));
}

// (3 - 2/z)^3: its zeros are the slow poles of the loop, so a move goes through the quick ones only. Sum 1: a
// move ends where the profile does.
constexpr double kForward[] = {27, -54, 36, -8};
// For the lag, its first difference and its sum. Their sum is 1, as for kForward.
constexpr double kBackward[] = {9490 / 256.0, -16377 / 256.0, 7143 / 256.0};
constexpr double kError = 28 / 4096.0;
// 1 - (1 - 1/z)^2 (1 + 1091/4096/z + 67/4096/z^2): two poles at 1, exact in the format, so nothing leaks.
constexpr double kTorque[] = {7101 / 4096.0, -1981 / 4096.0, -957 / 4096.0, -67 / 4096.0};

void write_speed_regulator(MotorMemory& memory) {
    const bool big = is_mac800(memory.model());
    const Filters& f = big ? kBigFilters : kSmallFilters;
    // MAC800 has no GEARB: its filters are in counts/sample, or VB's 16 would take KVB out of its range.
    const double unit = big ? 16 : 1;
    const double scale = big ? 3500.0 / 2500.0 : 1.0;  // of torque that an acceleration takes
    for (int n = 0; n < 4; ++n) memory.set(cell::KFF[n], fixed(kForward[n] / unit, f.one_f));
    for (int n = 0; n < 3; ++n) memory.set(cell::KVB[n], fixed(kBackward[n], f.one_f));
    memory.set(cell::KVFX, fixed(kError * scale * unit, f.one_vf));
    for (int n = 0; n < 4; ++n) memory.set(cell::KVFY[n], fixed(kTorque[n], f.one_vf));
    memory.set(cell::GEARB, fixed(16, f.one_f));
}

// Both poles of the loop at 0.4: an integrator in IF, and in IB the zero that it needs.
void write_current_loop(MotorMemory& memory) {
    const bool big = is_mac800(memory.model());
    const Filters& f = big ? kBigFilters : kSmallFilters;
    constexpr double kPole = 0.4;
    const MotorConstants& c = constants_of(memory.model());
    const double gain = (1 - kPole) * (1 - kPole) * c.resistance / (1 - c.decay);
    const double newest = (1 + c.decay - 2 * kPole) / ((1 - kPole) * (1 - kPole));
    memory.set(cell::KIFX2, fixed(gain, f.one_if));
    memory.set(cell::KIFY1, fixed(1, f.one_if));
    memory.set(cell::KIB1, fixed(newest, f.one_f));
    memory.set(cell::KIB0, fixed(1, f.one_f) - fixed(newest, f.one_f));
    memory.set(cell::AMPLITUDE, 212);
    memory.set(cell::PHASE_COMP, fixed(3, 256));
    for (int p = 0; p < (big ? 2 : 3); ++p) memory.set(cell::IA_OFFSET[p], 1024);
    for (int p = 0; p < (big ? 2 : 3); ++p) memory.set(cell::KIA[p], 256);
    memory.set(cell::ELDEGN_OFFSET, 2040);
    memory.set(cell::OUTLOOPDIV, kInnerSamples);
    memory.set(cell::DEGCMAX, 696);  // 85 degrees
}

/// 001 §3.2.153 to §3.2.158, 004: the identification of a motor. R: the manuals give no encoding, so these
/// are numbers of no real motor: 140, 999140008 at address 8, 99, and "VIRT".
void write_identity(MotorMemory& memory, std::uint8_t address) {
    std::int32_t type = 0;
    for (const char c : registers::name_of(memory.model()).substr(3)) type = 10 * type + (c - '0');
    memory.set(cell::MOTOR_TYPE, type);
    memory.set(cell::SERIAL_NUMBER, 999'000'000 + 1'000 * type + address);
    memory.set(cell::HW_VERSION, 99);
    memory.set(cell::CHKSUM, 0x56495254);
}

}  // namespace

// The registers as a line sees them: words.
std::uint32_t MotorMemory::read(std::uint8_t reg, bool longword) const {
    if (mac800_) return static_cast<std::uint32_t>(value(reg)) & (longword ? 0xFFFFFFFF : 0xFFFF);
    const std::uint32_t low = word(reg);
    return longword ? low | static_cast<std::uint32_t>(word(reg + 1U)) << 16 : low;
}

void MotorMemory::write(std::uint8_t reg, std::uint32_t value, bool longword) {
    cut_filters();
    const auto low = static_cast<std::uint16_t>(value);
    const auto next = static_cast<std::uint8_t>(reg + 1);
    if (mac800_) {
        values_[reg] = longword ? static_cast<std::int32_t>(value) : with_low(values_[reg], low);
    } else {
        set_word(reg, low);
        if (longword) set_word(reg + 1U, static_cast<std::uint16_t>(value >> 16));
    }
    const bool setting = sim::is_setting(model_, reg) || (longword && sim::is_setting(model_, next));
    if (setting) settings_written_.yes = true;
}

std::int32_t MotorMemory::value(std::size_t place) const {
    if (filters_.newer && place == place_of(cell::FF_OUT)) return shown(cell::FF_OUT.kind, filters_.ff_out);
    if (filters_.newer && place == place_of(cell::VB_OUT)) return shown(cell::VB_OUT.kind, filters_.vb_out);
    return values_[place];
}

void MotorMemory::cut_filters() {
    for (const Cell filter : {cell::FF_OUT, cell::VB_OUT})
        values_[place_of(filter)] = value(place_of(filter));
    filters_.newer = false;
}

std::uint16_t MotorMemory::word(std::size_t place) const {
    return static_cast<std::uint16_t>(is_high_word(place) ? values_[place - 1] >> 16 : value(place));
}

void MotorMemory::set_word(std::size_t place, std::uint16_t word) {
    if (is_high_word(place)) {
        const auto low = static_cast<std::uint16_t>(values_[place - 1]);
        values_[place - 1] = static_cast<std::int32_t>(low | static_cast<std::uint32_t>(word) << 16);
    } else if (kKinds[place] == Kind::long_int) {
        values_[place] = with_low(values_[place], word);
    } else {
        values_[place] = cut(kKinds[place], word);
    }
}

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
    write_identity(memory, address);
    write_speed_regulator(memory);
    write_current_loop(memory);
    for (int n = 0; n < 8; ++n) memory.set(cell::V1[n], d.v_step * (n + 1));
    for (int n = 0; n < 4; ++n) {
        memory.set(cell::A1[n], d.a_first << n);
        memory.set(cell::T1[n], 1023);
        memory.set(cell::L1[n], d.kvout_one);
        memory.set(cell::Z1[n], kInPosWindow);
    }
}

}  // namespace nplc::sim
