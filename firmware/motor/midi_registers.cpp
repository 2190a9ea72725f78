#include "motor/midi_registers.h"

namespace nplc::motor {
namespace {

using namespace registers;

constexpr unsigned kFirst[]{0x00, 0x08, 0x10, 0x14, 0x18, 0x1C};  ///< P V A T L Z in bits 4..0
constexpr unsigned kSize[]{8, 8, 4, 4, 0, 4};

}  // namespace

MidiRegisters::MidiRegisters() {
    set_word(MODE_REG, 0);
    set_position(P_SOLL, 0);
    for (unsigned p = P1; p < P1 + 16U; p += 2) set_position(p, 0);
}

unsigned MidiRegisters::place(unsigned number) {
    if (number >= MODE_REG && number <= T_SOLL) return number - MODE_REG;
    if (number == INPOSWIN) return 6;
    if (number >= P1 && number < P1 + 32U) return number - P1 + 7U;
    if (number >= Z1 && number < Z1 + 4U) return number - Z1 + 39U;
    return kWords;
}

bool MidiRegisters::is_set(unsigned number) const {
    const unsigned at = place(number);
    return at < kWords && set_[at];
}

void MidiRegisters::unset(unsigned number) {
    set_word(number, 0);
    if (const unsigned at = place(number); at < kWords) set_[at] = false;
}

std::uint16_t MidiRegisters::word(unsigned number) const {
    const unsigned at = place(number);
    return at < kWords ? words_[at] : std::uint16_t{0};
}

void MidiRegisters::set_word(unsigned number, std::uint16_t value) {
    const unsigned at = place(number);
    if (at >= kWords) return;
    words_[at] = value;
    set_[at] = true;
}

std::int32_t MidiRegisters::position(unsigned number) const {
    return static_cast<std::int32_t>(std::uint32_t{word(number + 1)} << 16 | word(number));
}

void MidiRegisters::set_position(unsigned number, std::int32_t counts) {
    set_word(number, static_cast<std::uint16_t>(counts));
    set_word(number + 1, static_cast<std::uint16_t>(static_cast<std::uint32_t>(counts) >> 16));
}

void MidiRegisters::copy(unsigned from, unsigned to) {
    if (is_set(from)) set_word(to, word(from));
}

void MidiRegisters::select(unsigned low, bool relative) {
    if (low < kFirst[1]) {
        const auto from = static_cast<std::uint32_t>(position(P1 + 2 * low));
        const auto base = relative ? static_cast<std::uint32_t>(position(P_SOLL)) : 0U;
        set_position(P_SOLL, static_cast<std::int32_t>(base + from));
    } else if (low < kFirst[2]) {
        copy(V1 + low - kFirst[1], V_SOLL);
    } else if (low < kFirst[3]) {
        copy(A1 + low - kFirst[2], A_SOLL);
    } else if (low < kFirst[4]) {
        copy(T1 + low - kFirst[3], T_SOLL);
    } else if (low >= kFirst[5]) {
        copy(Z1 + low - kFirst[5], INPOSWIN);
    }
}

void MidiRegisters::select_set(unsigned n, bool relative) {
    for (const unsigned first : kFirst) select(first + n - 1, relative);
}

void MidiRegisters::select_by_pointer(unsigned number, std::uint16_t n, bool relative) {
    const unsigned group = number - P_REG_P;
    if (n >= 1 && n <= kSize[group]) select(kFirst[group] + n - 1U, relative);
}

}  // namespace nplc::motor
