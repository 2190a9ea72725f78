#include "motor/midi_registers.h"

namespace nplc::motor {
namespace {

using namespace registers;

constexpr unsigned kFirst[]{0x00, 0x08, 0x10, 0x14, 0x18, 0x1C};  ///< P V A T L Z in bits 4..0
constexpr unsigned kSize[]{8, 8, 4, 4, 0, 4};

}  // namespace

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

void MidiRegisters::add_to_p_soll(std::uint32_t base, unsigned from) {
    set_position(P_SOLL, static_cast<std::int32_t>(base + static_cast<std::uint32_t>(position(from))));
}

void MidiRegisters::select(unsigned low) {
    if (low < kFirst[1]) {
        add_to_p_soll(relative_ ? static_cast<std::uint32_t>(position(P_SOLL)) : 0U, P1 + 2 * low);
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

/// A set consists of P, V, A, T and Z; a MIDI drive has no L.
void MidiRegisters::execute(std::uint8_t number) {
    switch (number) {
        case 0x02:
            return set_position(P_SOLL, 0);
        case 0x05:
            return set_word(V_SOLL, 0);
        case 0x06:
            return set_word(T_SOLL, 0);
        case 0x0C:
        case 0x0D:
        case 0x0E:
        case 0x0F:
            for (const unsigned first : kFirst) select(first + number - 0x0CU);
            return;
        case 0x11:
        case 0x12:
            base_ = static_cast<std::uint8_t>(number - 0x0A);
            return;
        case 0x14:
        case 0x15:
            relative_ = number == 0x15;
            return;
        default:
            return;  // NOP, 07h, and commands for JVL's line
    }
}

void MidiRegisters::write(unsigned number, std::uint16_t value) {
    if (number < P_REG_P || number > Z_REG_P) return set_word(number, value);
    const unsigned group = number - P_REG_P;
    if (value >= 1 && value <= kSize[group]) select(kFirst[group] + value - 1U);
}

void MidiRegisters::on_position(std::int32_t counts) {
    if (!awaits_position()) return;
    add_to_p_soll(static_cast<std::uint32_t>(counts), P1 + 2U * (base_ - 1U));
    base_ = 0;
}

}  // namespace nplc::motor
