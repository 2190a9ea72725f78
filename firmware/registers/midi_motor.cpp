#include "registers/midi_motor.h"

#include "registers/mac.h"

namespace nplc::registers::midi {
namespace {

constexpr std::uint8_t kCommandMode = 3;
constexpr std::uint8_t kFirstL = 0x18;  ///< bits 4..0 of a selection (001 §5.2.1.4)
constexpr std::uint8_t kFirstZ = 0x1C;
constexpr std::uint32_t kMostTorqueOfT = 1'023;
constexpr std::uint32_t kLongestPeriod = 0xFFFF;

/// increments = counts x kIncrements / 256: 2000 / 4096 and 10000 / 4096.
constexpr std::int32_t kCounts = 256;
constexpr std::int32_t kIncrements23 = 125;
constexpr std::int32_t kIncrements34 = 625;

constexpr std::int32_t increments_in_256(Model model) {
    return model == Model::mac23 ? kIncrements23 : kIncrements34;
}

/// A unit of V_SOLL is 15625 / 32768 rpm (3125 / 6 samples a second, 4096 x 16 steps a revolution); rpm x
/// period is 48000 on MAC34. So V_SOLL x period is 48000 x 32768 / 15625 = 12582912 / 125.
constexpr std::uint32_t kSpeedDivisor = 125;
constexpr std::uint32_t kSpeed34 = 12'582'912;

constexpr std::uint32_t speed_dividend(Model model) {
    return model == Model::mac23 ? 5 * kSpeed34 : kSpeed34;
}

/// A unit of A_SOLL is 9765625 / 576 counts/s^2, so 9765625 / 576 x 625 / 256 increments/s^2 on MAC34. AA x
/// A_SOLL x period^2 is at least 8000000^2 / 240 divided by it, 6442450.944; on MAC23 5 times that. Whole
/// products reach it only at the next whole number.
constexpr std::uint32_t kRamp34 = 6'442'451;
constexpr std::uint32_t kRamp23 = 32'212'255;

struct Span {
    std::uint8_t first;
    std::uint8_t last;
    constexpr bool has(unsigned cell) const { return cell >= first && cell <= last; }
};

constexpr Span kP{P1, P1 + 15};
constexpr Span kV{V1, V1 + 7};
constexpr Span kA{A1, A1 + 3};
constexpr Span kT{T1, T1 + 3};
constexpr Span kL{L1, L1 + 3};
constexpr Span kZ{Z1, Z1 + 3};
constexpr Span kHome{P_HOME, HOME_MODE};
constexpr Span kPointers{P_REG_P, Z_REG_P};

bool is_pair(std::uint8_t reg) {
    return reg == P_SOLL || (kP.has(reg) && (reg - P1) % 2 == 0);
}

/// A register that exists and accepts any word.
bool takes_any(unsigned cell) {
    if (cell == P_SOLL || cell == P_SOLL + 1U) return true;
    return kP.has(cell) || (kPointers.has(cell) && cell != L_REG_P);
}

Limitation limitation_of_missing(unsigned cell) {
    if (kL.has(cell) || cell == L_REG_P || cell == KVOUT) return Limitation::load_factor;
    if (cell == P_FNC || cell == P_FNC + 1U) return Limitation::function_error;
    if (cell == P_IST || cell == P_IST + 1U) return Limitation::actual_position;
    if (kHome.has(cell)) return Limitation::homing;
    if (cell == GEARF1 || cell == GEARF2 || cell == V_EXT) return Limitation::gear;
    return cell == ANINP ? Limitation::analogue : Limitation::no_register;
}

Limitation limitation_of_word(Model model, unsigned cell, std::uint16_t value) {
    if (takes_any(cell)) return Limitation::none;
    if (cell == MODE_REG) return value <= 2 ? Limitation::none : Limitation::mode;
    if (cell == V_SOLL || kV.has(cell))
        return period_of_v_soll(model, static_cast<std::int16_t>(value)) ? Limitation::none
                                                                         : Limitation::too_slow;
    if (cell == A_SOLL || kA.has(cell)) return value != 0 ? Limitation::none : Limitation::no_acceleration;
    if (cell == T_SOLL || kT.has(cell))
        return value <= kMostTorqueOfT ? Limitation::none : Limitation::too_much_torque;
    if (cell == INPOSWIN || kZ.has(cell))
        return tolerance_of_window(model, value) ? Limitation::none : Limitation::window;
    return limitation_of_missing(cell);
}

/// 001 §5.2.1.4. The link's own commands (0Ah, 0Bh, 13h, 1Dh to 1Fh) and NOPs have no effect here.
Limitation limitation_of_number(std::uint8_t number) {
    switch (number) {
        case 0x04:
        case 0x08:
        case 0x09:
        case 0x16:
            return Limitation::function_error;
        case 0x10:
            return Limitation::homing;
        default:
            return Limitation::none;
    }
}

}  // namespace

std::string_view text_of(Limitation limitation) {
    switch (limitation) {
        case Limitation::none:
            return "the MIDI drive can do this";
        case Limitation::load_factor:
            return "a MIDI drive has no load factor: leave out the L registers and KVOUT";
        case Limitation::function_error:
            return "a MIDI drive has no P_FNC: move to positions, by MOVE_P7_BY_P_SOLL (or P8), or with "
                   "POSITIONS_RELATIVE_P_SOLL";
        case Limitation::homing:
            return "a MIDI drive searches no home: move to a sensor, then CLEAR_P_IST makes 0 of that place";
        case Limitation::mode:
            return "a MIDI drive has modes 0 (stop), 1 (velocity) and 2 (position) only";
        case Limitation::gear:
            return "a MIDI drive has no pulse input and no gear";
        case Limitation::analogue:
            return "a MIDI drive has no analogue input";
        case Limitation::actual_position:
            return "a MIDI drive's position can only be set to 0: CLEAR_P_IST, or P_IST := 0";
        case Limitation::no_register:
            return "a MIDI drive has nothing that this register could set";
        case Limitation::too_far:
            return "this position is beyond a MIDI drive's -1073741824 to 1073741823 increments";
        case Limitation::too_slow:
            return "a MIDI drive cannot turn so slowly: V 0, or at least 2 on MAC34 and 8 on MAC23 (0.95 and "
                   "3.8 rpm)";
        case Limitation::no_speed:
            return "the MIDI drive's own speed is none (period 0): select or write V before a move";
        case Limitation::no_acceleration:
            return "acceleration 0 would have no limit on a MIDI drive: give A at least one step, 248.4 "
                   "rpm/s";
        case Limitation::too_soft:
            return "this speed with this acceleration needs a ramp of more than 30600 increments: raise A or "
                   "lower V";
        case Limitation::too_much_torque:
            return "torque above 1023 does not exist";
        case Limitation::window:
            return "a MIDI drive's window (INPOSWIN, Z) is 1 to 104 counts on MAC34 and 1 to 524 on MAC23";
    }
    return {};
}

Limitation limitation_of_command(std::uint8_t command) {
    const auto mode = static_cast<std::uint8_t>(command >> 5 & 3);
    const auto low = static_cast<std::uint8_t>(command & 0x1F);
    if (mode == kCommandMode) return limitation_of_number(low);
    return low >= kFirstL && low < kFirstZ ? Limitation::load_factor : Limitation::none;
}

Limitation limitation_of_write(Model model, std::uint8_t reg, bool longword, std::uint32_t value) {
    if (longword && reg == P_IST) return value == 0 ? Limitation::none : Limitation::actual_position;
    const Limitation limitation = limitation_of_word(model, reg, static_cast<std::uint16_t>(value));
    if (limitation != Limitation::none || !longword) return limitation;
    if (is_pair(reg)) {
        const bool fits = increments_of_counts(model, static_cast<std::int32_t>(value)).has_value();
        return fits ? Limitation::none : Limitation::too_far;
    }
    return limitation_of_word(model, reg + 1U, static_cast<std::uint16_t>(value >> 16));
}

Limitation limitation_of_profile(Model model, std::int16_t v_soll, std::uint16_t a_soll) {
    if (v_soll == 0) return Limitation::none;
    const auto period = period_of_v_soll(model, v_soll);
    if (!period) return Limitation::too_slow;
    if (a_soll == 0) return Limitation::no_acceleration;
    return ramp_of_a_soll(model, a_soll, *period) ? Limitation::none : Limitation::too_soft;
}

std::optional<std::int32_t> increments_of_counts(Model model, std::int32_t counts) {
    const std::int32_t factor = increments_in_256(model);
    const std::int32_t whole = counts >> 8;
    constexpr std::int32_t kMost = kMaxPosition / kIncrements34 + 1;
    if (model != Model::mac23 && (whole > kMost || whole < -kMost)) return std::nullopt;
    const std::int32_t rest = ((counts & 0xFF) * factor + kCounts / 2) >> 8;
    const std::int32_t increments = whole * factor + rest;
    if (increments < kMinPosition || increments > kMaxPosition) return std::nullopt;
    return increments;
}

std::int32_t counts_of_increments(Model model, std::int32_t increments) {
    const std::int32_t factor = increments_in_256(model);
    std::int32_t whole = increments / factor;
    std::int32_t rest = increments % factor;
    if (rest < 0) {
        rest += factor;
        --whole;
    }
    const auto rounded = static_cast<std::uint32_t>((rest * kCounts + factor / 2) / factor);
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(whole) * kCounts + rounded);
}

std::optional<std::uint16_t> period_of_v_soll(Model model, std::int16_t v_soll) {
    if (v_soll == 0) return std::uint16_t{0};
    const auto magnitude = static_cast<std::uint32_t>(v_soll < 0 ? -std::int32_t{v_soll} : v_soll);
    const std::uint32_t divisor = kSpeedDivisor * magnitude;
    const std::uint32_t dividend = speed_dividend(model);
    if (dividend / divisor >= kLongestPeriod) return std::nullopt;
    return static_cast<std::uint16_t>((dividend + divisor / 2) / divisor);
}

std::int16_t v_soll_of_period(Model model, std::uint16_t period) {
    if (period == 0) return 0;
    const std::uint32_t divisor = kSpeedDivisor * period;
    const std::uint32_t v_soll = (speed_dividend(model) + divisor / 2) / divisor;
    return static_cast<std::int16_t>(v_soll < 0x7FFF ? v_soll : 0x7FFF);
}

std::optional<std::uint8_t> ramp_of_a_soll(Model model, std::uint16_t a_soll, std::uint16_t period) {
    if (a_soll == 0 || period == 0) return std::nullopt;
    const std::uint32_t wanted = model == Model::mac23 ? kRamp23 : kRamp34;
    const std::uint64_t unit = std::uint64_t{period} * period * a_soll;
    if (unit >= wanted) return std::uint8_t{1};
    const auto small = static_cast<std::uint32_t>(unit);
    const std::uint32_t ramp = (wanted + small - 1) / small;
    if (ramp > 0xFF) return std::nullopt;
    return static_cast<std::uint8_t>(ramp);
}

std::optional<std::uint8_t> torque_of_t_soll(std::uint16_t t_soll, std::uint8_t imax) {
    if (t_soll > kMostTorqueOfT) return std::nullopt;
    return static_cast<std::uint8_t>(std::uint32_t{t_soll} * imax / kMostTorqueOfT);
}

std::optional<std::uint8_t> tolerance_of_window(Model model, std::uint16_t window) {
    if (window == 0) return std::nullopt;
    const auto factor = static_cast<std::uint32_t>(increments_in_256(model));
    const std::uint32_t scaled = (window * factor + kCounts - 1) / kCounts;
    if (scaled > 0x100) return std::nullopt;
    return static_cast<std::uint8_t>(scaled - 1);
}

}  // namespace nplc::registers::midi
