#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "registers/mac.h"
#include "sim/bounds.h"

namespace nplc::sim {

constexpr bool is_mac800(registers::Model model) {
    return model == registers::Model::mac800;
}

/// A register as used by the motor's program: its place in either family, and its type.
struct Cell {
    enum class Kind : std::uint8_t { word, integer, long_int };
    std::uint8_t small;  ///< number on MAC50-141 (001 §3.2); 0: that family has none
    std::uint8_t big;    ///< number on MAC800 (004)
    Kind kind;           ///< on MAC50-141; every MAC800 register is a signed longword

    /// The n-th of a row of registers, from 0. LongInts take two numbers each.
    constexpr Cell operator[](int n) const {
        const auto step = static_cast<std::uint8_t>(n * (kind == Kind::long_int ? 2 : 1));
        return {static_cast<std::uint8_t>(small + step), static_cast<std::uint8_t>(big + step), kind};
    }
};

namespace cell {
constexpr Cell word(std::uint8_t small, std::uint8_t big) {
    return {small, big, Cell::Kind::word};
}
constexpr Cell integer(std::uint8_t small, std::uint8_t big) {
    return {small, big, Cell::Kind::integer};
}
constexpr Cell long_int(std::uint8_t small, std::uint8_t big) {
    return {small, big, Cell::Kind::long_int};
}

inline constexpr Cell PROG_VERSION = word(1, 1), MODE_REG = word(2, 2), P_SOLL = long_int(3, 3),
                      V_SOLL = integer(5, 5), A_SOLL = word(6, 6), T_SOLL = word(7, 7),
                      P_FNC = long_int(8, 8), P_IST = long_int(10, 10), V_IST = integer(12, 12),
                      KVOUT = word(13, 13), GEARF1 = integer(14, 14), GEARF2 = word(15, 15),
                      I2T = word(16, 16), I2TLIM = word(17, 17), UIT = word(18, 18), UITLIM = word(19, 19),
                      FLWERR = long_int(20, 20), FLWERRMAX = long_int(22, 22), FNCERR = long_int(24, 24),
                      FNCERRMAX = long_int(26, 26), MIN_P_IST = long_int(28, 28),
                      MAX_P_IST = long_int(30, 30), ACC_EMERG = word(32, 32), INPOSWIN = word(33, 33),
                      INPOSCNT = word(34, 34), ERR_STAT = word(35, 35), CNTRL_BITS = word(36, 36),
                      STARTMODE = word(37, 37), P_HOME = long_int(38, 38), V_HOME = integer(40, 40),
                      T_HOME = integer(41, 41), HOME_MODE = word(42, 42), P_REG_P = word(43, 43),
                      V_REG_P = word(44, 44), A_REG_P = word(45, 45), T_REG_P = word(46, 46),
                      L_REG_P = word(47, 47), Z_REG_P = word(48, 48), P1 = long_int(49, 49),
                      V1 = integer(65, 65), A1 = word(73, 73), T1 = word(77, 77), L1 = word(81, 81),
                      Z1 = word(85, 85), FNC_OUT = integer(117, 166), V_EXT = integer(120, 163),
                      VF_OUT = integer(121, 169), ANINP = integer(122, 170), ANINP_OFFSET = integer(123, 171),
                      MYADDR = word(156, 202), MOTOR_TYPE = word(153, 203),
                      SERIAL_NUMBER = long_int(154, 204), HW_VERSION = word(157, 205),
                      CHKSUM = long_int(158, 206), G_FNC = long_int(0, 165), HW_SETUP = word(0, 39),
                      P_NEW = long_int(163, 4), V_IST_16 = integer(0, 11), SAMPLE1 = word(112, 158),
                      REC_CNT = word(116, 162);

// Filters (001 §3.2.89 - 111; 004 gives FF and VF two more coefficients, VB one)
inline constexpr Cell KFF = integer(89, 121), KVFX = integer(93, 127), KVFY = integer(97, 133),
                      GEARB = integer(101, 0), KVB = integer(102, 139), KIFX2 = integer(106, 144),
                      KIFX1 = integer(107, 145), KIFY1 = integer(108, 146), KIFY0 = integer(109, 147),
                      KIB1 = integer(110, 148), KIB0 = integer(111, 149), FF_OUT = integer(118, 167),
                      VB_OUT = integer(119, 168);
// Current loop and supply (001 §3.2.124 - 152, 004)
inline constexpr Cell ELDEGN_OFFSET = word(124, 0), ELDEGP_OFFSET = word(125, 0), ELDEG_OFFSET = word(0, 172),
                      PHASE_COMP = integer(126, 173), AMPLITUDE = integer(127, 174),
                      MAN_I_NOM = word(128, 175), MAN_ALPHA = word(129, 176), UMEAS = word(130, 177),
                      I_NOM = word(131, 178), PHI_SOLL = word(132, 179), IA_SOLL = integer(133, 180),
                      IA_IST = integer(137, 183), IA_OFFSET = word(140, 186), IC_OFFSET = word(142, 0),
                      KIA = word(148, 188), KIC = word(150, 0), ELDEG_IST = word(143, 190),
                      V_ELDEG = integer(144, 191), UA_VAL = integer(145, 192), U_SUPPLY = word(151, 198),
                      EMK_A = integer(0, 195), U_24V = word(0, 21), DEGC = word(0, 29), DEGCMAX = word(0, 31),
                      OUTLOOPDIV = word(0, 157), U_MIN_SUP = word(152, 0), UV_HANDLE = word(160, 23);
}  // namespace cell

/// Whether a register is a coefficient of the regulators' filters or the commutation (001 §3.2.13, §3.2.89 to
/// §3.2.111, §3.2.124 to §3.2.127, §3.2.140 to §3.2.142, §3.2.148 to §3.2.150; 004).
constexpr bool is_setting(registers::Model model, std::uint8_t reg) {
    const auto in = [reg](int first, int last) { return reg >= first && reg <= last; };
    if (reg == 13) return true;  // KVOUT
    if (is_mac800(model)) return in(121, 149) || in(172, 174) || in(186, 189);
    return in(89, 111) || in(124, 127) || in(140, 142) || in(148, 150);
}

/// All registers of one motor, as numbers in the form that the motor's program uses in each sample. The line
/// sees words. MAC50-141: 16-bit words by register number, a LongInt takes its number (low word) and the next
/// (001 §3.1, §3.2). MAC800: one longword each (004). Unwritten registers read 0; no access is refused.
class MotorMemory {
  public:
    explicit MotorMemory(registers::Model model) : model_(model), mac800_(is_mac800(model)) {}

    registers::Model model() const { return model_; }

    /// Value by the cell's kind; a cell that the model does not have reads 0 and is not written.
    std::int32_t get(Cell cell) const { return values_[place_of(cell)]; }
    /// Truncated to the cell's width.
    void set(Cell cell, std::int32_t value) {
        const std::size_t place = place_of(cell);
        if (place == kNowhere) return;
        values_[place] = mac800_ ? value : cut(cell.kind, value);
        if (is_setting(cell)) settings_written_.yes = true;
    }
    /// For display values that are no settings: truncated to an integer and limited to the cell's range.
    /// Returns the stored value.
    std::int32_t show(Cell cell, double value) {
        const std::size_t place = place_of(cell);
        return place == kNowhere ? 0 : values_[place] = shown(cell.kind, value);
    }

    /// The same for FF_OUT and VB_OUT, which only lines read: converted when they are read.
    void show_filters(double ff_out, double vb_out) { filters_ = {ff_out, vb_out, true}; }

    /// As the line sees it: 16 bits, or with `longword` 32. MAC50-141: a longword is `reg` and the number
    /// after it. MAC800: a word is the register's low half.
    std::uint32_t read(std::uint8_t reg, bool longword) const;
    void write(std::uint8_t reg, std::uint32_t value, bool longword);

    /// Whether a setting may have been written since the last call. True for a new copy.
    bool take_settings_written() { return std::exchange(settings_written_.yes, false); }

  private:
    /// A copy does not take over what was already read of the original.
    struct Written {
        bool yes = true;

        Written() = default;
        Written(const Written& /*other*/) {}
        Written& operator=(const Written& /*other*/) {
            yes = true;
            return *this;
        }
    };
    static constexpr std::size_t kPlaces = 257;       // a longword at 255 reaches beyond the last number
    static constexpr std::size_t kNowhere = kPlaces;  // always 0

    /// In either family, evaluated at compile time; treating the other family's as a setting too is harmless.
    static constexpr bool is_setting(Cell cell) {
        return sim::is_setting(registers::Model::mac140, cell.small) ||
               sim::is_setting(registers::Model::mac800, cell.big);
    }
    static constexpr std::int32_t cut(Cell::Kind kind, std::int32_t value) {
        if (kind == Cell::Kind::word) return static_cast<std::uint16_t>(value);
        return kind == Cell::Kind::integer ? static_cast<std::int16_t>(value) : value;
    }
    std::int32_t shown(Cell::Kind kind, double value) const {
        constexpr double kMost = 2'000'000'000;
        const bool wide = mac800_ || kind == Cell::Kind::long_int;
        return static_cast<std::int32_t>(wide                       ? within(value, kMost)
                                         : kind == Cell::Kind::word ? within(value, 0, 0xFFFF)
                                                                    : within(value, -0x8000, 0x7FFF));
    }
    void cut_filters();
    static constexpr std::size_t place_of(std::uint8_t number) { return number == 0 ? kNowhere : number; }
    std::size_t place_of(Cell cell) const { return mac800_ ? place_of(cell.big) : place_of(cell.small); }
    std::int32_t value(std::size_t place) const;
    std::uint16_t word(std::size_t place) const;
    void set_word(std::size_t place, std::uint16_t word);

    struct Filters {
        double ff_out = 0;
        double vb_out = 0;
        bool newer = false;  ///< newer than the value in values_
    };

    registers::Model model_;
    bool mac800_;
    Filters filters_;
    Written settings_written_;
    std::array<std::int32_t, kPlaces + 1> values_{};  // by number; a LongInt's second number is not used
};

/// Factory values of a motor; own choice, see the folder's README.
void write_defaults(MotorMemory& memory, std::uint8_t address);

}  // namespace nplc::sim
