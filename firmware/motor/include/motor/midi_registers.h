#pragma once

#include <array>
#include <cstdint>

#include "registers/mac.h"

namespace nplc::motor {

/// The JVL motor registers that a sequence uses (001 §3.2, numbers of MAC50-141), as words, kept for a drive
/// that has none. A register that was never written is unset: the drive's own value applies, and selecting it
/// changes nothing. Positions and the mode begin with 0.
class MidiRegisters {
  public:
    /// 0 for an unsupported or unset register.
    std::uint16_t word(unsigned number) const;
    /// Does nothing for an unsupported register.
    void set_word(unsigned number, std::uint16_t value);
    std::int32_t position(unsigned number) const;
    void set_position(unsigned number, std::int32_t counts);

    /// Not for positions and MODE_REG: they begin with 0.
    bool is_set(unsigned number) const;
    void unset(unsigned number);

    std::uint16_t mode() const { return word(registers::MODE_REG); }
    std::int32_t v_soll() const { return static_cast<std::int16_t>(word(registers::V_SOLL)); }

    /// Effect of a FastMAC register selection (001 §5.2.1.4), `low` its bits 4..0.
    void select(unsigned low);
    /// Effect of a numbered FastMAC command on the registers.
    void execute(std::uint8_t number);
    /// A word written by a sequence. P_REG_P .. Z_REG_P select; out of range they do nothing (R).
    void write(unsigned number, std::uint16_t value);

    /// RELPOSPSOLL: the selected register is added to P_SOLL.
    bool is_relative() const { return relative_; }
    /// After 11h or 12h: P_SOLL becomes the next reported position plus P7 or P8.
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
