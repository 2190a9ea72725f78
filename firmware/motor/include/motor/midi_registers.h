#pragma once

#include <array>
#include <cstdint>

#include "registers/mac.h"

namespace nplc::motor {

/// The registers of a JVL motor that a sequence knows (001 §3.2, numbers of MAC50-141), as words, kept for a
/// drive that has none. One that was never written is unset: the drive's own value holds, and selecting it
/// changes nothing. Positions and the mode begin with 0.
class MidiRegisters {
  public:
    /// 0 for a number that is not kept, and for unset ones.
    std::uint16_t word(unsigned number) const;
    /// Does nothing for a number that is not kept.
    void set_word(unsigned number, std::uint16_t value);
    std::int32_t position(unsigned number) const;
    void set_position(unsigned number, std::int32_t counts);

    /// Not asked of a position, nor of MODE_REG: they begin with 0.
    bool is_set(unsigned number) const;
    void unset(unsigned number);

    std::uint16_t mode() const { return word(registers::MODE_REG); }
    std::int32_t v_soll() const { return static_cast<std::int16_t>(word(registers::V_SOLL)); }

    /// What a FastMAC selection does (001 §5.2.1.4), `low` its bits 4..0.
    void select(unsigned low);
    /// What a numbered FastMAC command does to them.
    void execute(std::uint8_t number);
    /// A word that a sequence writes. P_REG_P .. Z_REG_P select; out of range they do nothing (R).
    void write(unsigned number, std::uint16_t value);

    /// RELPOSPSOLL: what is selected for P_SOLL is added.
    bool is_relative() const { return relative_; }
    /// 11h, 12h: P_SOLL becomes the next position plus P7 or P8.
    bool awaits_position() const { return base_ != 0; }
    void on_position(std::int32_t counts);
    void drop_awaited() { base_ = 0; }

  private:
    static constexpr unsigned kWords = 43;
    static unsigned place(unsigned number);
    void copy(unsigned from, unsigned to);
    void add_to_p_soll(std::uint32_t base, unsigned from);

    std::array<std::uint16_t, kWords> words_{};
    std::array<bool, kWords> set_{};
    bool relative_ = false;
    std::uint8_t base_ = 0;  ///< 7 or 8
};

}  // namespace nplc::motor
