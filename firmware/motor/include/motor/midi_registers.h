#pragma once

#include <array>
#include <cstdint>

#include "registers/mac.h"

namespace nplc::motor {

/// The registers of a JVL motor that a sequence knows (001 §3.2, numbers of MAC50-141), as words, kept for a
/// drive that has none. One that was never written is unset: the drive's own value holds, and selecting it
/// changes nothing. Positions begin with 0.
class MidiRegisters {
  public:
    MidiRegisters();

    /// 0 for a number that is not kept, and for unset ones.
    std::uint16_t word(unsigned number) const;
    /// Does nothing for a number that is not kept.
    void set_word(unsigned number, std::uint16_t value);
    std::int32_t position(unsigned number) const;
    void set_position(unsigned number, std::int32_t counts);

    bool is_set(unsigned number) const;
    void unset(unsigned number);

    /// What a FastMAC selection does (001 §5.2.1.4), `low` its bits 4..0. P adds where `relative` is set.
    void select(unsigned low, bool relative);
    /// P, V, A, T and Z `n`, 1..4; L is none of a MIDI drive's.
    void select_set(unsigned n, bool relative);
    /// A write to P_REG_P .. Z_REG_P. Out of range it does nothing (R).
    void select_by_pointer(unsigned number, std::uint16_t n, bool relative);

  private:
    static constexpr unsigned kWords = 43;
    static unsigned place(unsigned number);
    void copy(unsigned from, unsigned to);

    std::array<std::uint16_t, kWords> words_{};
    std::array<bool, kWords> set_{};
};

}  // namespace nplc::motor
