// The registers as a line sees them: words.
#include "sim/motor_memory.h"

namespace nplc::sim {
namespace {

using Kind = Cell::Kind;

/// Of each number of MAC50-141; the second of a LongInt does not count.
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

}  // namespace

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

}  // namespace nplc::sim
