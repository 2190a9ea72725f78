#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include "macreg/change.h"
#include "macreg/parameters.h"
#include "macreg/values.h"
#include "registers/details.h"
#include "why_parts.h"

// MIN_P_IST, MAX_P_IST and FLWERRMAX, and how a motion is begun that does not pass them.
namespace nplc::macreg {

using enum registers::Number;

namespace {

/// One error bit: what it means for the owner, and what mends it.
struct Error {
    const char* name;  ///< of the field in ERR_STAT
    const char* sentence;
    const char* remedy;
    std::array<std::string_view, 4> registers{};
};

constexpr Error kErrors[] = {
    {"I2T_ERR",
     "The windings were too hot, as computed (I2T above I2TLIM), and the motor made itself passive.",
     "Free the shaft if something holds it; let it cool down; use less torque or acceleration, less load, "
     "more pauses.",
     {"I2T", "I2TLIM"}},
    {"UIT_ERR",
     "Braking gave back more energy than the motor can burn (UIT above UITLIM), and it made itself passive.",
     "Brake more gently (A_SOLL), or mount an external power dump.",
     {"UIT", "UITLIM", "A_SOLL"}},
    {"FLW_ERR",
     "The motor could not follow (FLWERR passed FLWERRMAX) and made itself passive.",
     "Free the shaft, allow more torque (T_SOLL), ask for less acceleration (A_SOLL), or widen FLWERRMAX.",
     {"FLWERR", "FLWERRMAX", "T_SOLL", "A_SOLL"}},
    {"FNC_ERR",
     "The torque was too small for the profile (FNCERR passed FNCERRMAX) and the motor made itself passive.",
     "Free the shaft, allow more torque (T_SOLL), ask for less acceleration (A_SOLL), or widen FNCERRMAX.",
     {"FNCERR", "FNCERRMAX", "T_SOLL", "A_SOLL"}},
    {"PLIM_ERR",
     "The shaft left its position limits (MIN_P_IST, MAX_P_IST) and the motor made itself passive.",
     "",
     {"P_IST", "MIN_P_IST", "MAX_P_IST"}},
    {"UV_ERR",
     "The supply voltage was too low.",
     "Mend the supply: voltage, fuse, cross-section, inrush.",
     {"U_SUPPLY", "U_BUS", "U_MIN_SUP", "UV_HANDLE"}},
    {"DEGC_ERR",
     "The motor is too hot (DEGC above DEGCMAX) and made itself passive.",
     "Let it cool down; use less torque, or cool it.",
     {"DEGC", "DEGCMAX"}},
    {"OV_ERR",
     "The bus voltage was too high, mostly by braking.",
     "Brake more gently (A_SOLL), or mount an external power dump.",
     {"U_BUS", "A_SOLL"}},
    {"IPEAK_ERR",
     "The current in the windings was too high.",
     "Look for a short circuit; bring the filters' parameters back.",
     {}},
    {"SPEED_ERR",
     "The motor was faster than it may be.",
     "Ask for less velocity; look for a load that drives the shaft.",
     {"V_SOLL", "V_IST"}},
    {"INDEX_ERR",
     "The encoder has a fault.",
     "Switch the motor off and on; if it stays, the motor needs repair.",
     {}},
    {"OLD_FILT_ERR", "The filters' parameters are not valid.", "", {}},
    {"U24V_ERR", "The control supply was too low.", "Mend the 24 V supply.", {"U_24V"}},
};

std::vector<std::uint8_t> numbers(const Facts& facts, std::span<const std::string_view> names) {
    std::vector<std::uint8_t> all{ERR_STAT};
    for (const std::string_view name : names) {
        if (facts.knows(name)) all.push_back(facts.number(name));
    }
    return all;
}

std::string code_of(std::string_view name) {
    std::string code = "error_";
    for (const char c : name) code += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return code;
}

bool is_set(const Facts& facts, std::string_view bit) {
    const registers::Field* field = registers::field_of(facts.model(), ERR_STAT, bit);
    return field != nullptr &&
           (static_cast<std::uint32_t>(facts.at(ERR_STAT)) & registers::mask_of(*field)) != 0;
}

std::string remedy_of(const Facts& facts, const Error& error) {
    const std::string_view name = error.name;
    if (name == "PLIM_ERR") return way_back(facts);
    const std::string then = fmt::format("Then {}.", clear_words(facts));
    if (name == "OLD_FILT_ERR") return fmt::format("{} {}", restore_words(facts), then);
    return fmt::format("{} {}", error.remedy, then);
}

/// A supply that is there may be measured against a limit that is wrong.
std::string supply_remedy(const Facts& facts) {
    constexpr std::int64_t kPlausible = 223;  // 12 V, a step is 53.7 mV (001 §3.2.151)
    const std::string mend = "Switch the power supply on; check voltage, fuse and cross-section.";
    if (facts.large() || facts.at("U_SUPPLY") < kPlausible) return mend;
    return fmt::format(
        "If {} is what the supply is to give, the limit is wrong: `macreg set U_MIN_SUP {}V --force`. If "
        "not: {}",
        facts.text("U_SUPPLY"), facts.at("U_SUPPLY") * 537 / 10'000 * 3 / 4, mend);
}

void judge_supply(const Facts& facts, Findings& findings) {
    if (!is_set(facts, "UV_DETECT")) return;
    const std::string_view name = facts.large() ? "U_BUS" : "U_SUPPLY";
    if (!facts.large() && facts.at(name) >= facts.at("U_MIN_SUP") * 5 / 4 && facts.at(name) > 0) {
        findings.hinders("undervoltage_recent",
                         fmt::format("The supply was too low a moment ago; it is {} now.", facts.text(name)),
                         {ERR_STAT, facts.number(name), facts.number("U_MIN_SUP")},
                         "Ask again in a second; if it comes back, the supply sags under load.");
        return;
    }
    std::vector<std::uint8_t> seen{ERR_STAT, facts.number(name)};
    if (facts.knows("U_MIN_SUP")) seen.push_back(facts.number("U_MIN_SUP"));
    const std::string least =
        facts.knows("U_MIN_SUP") ? fmt::format(" ({})", facts.text("U_MIN_SUP")) : std::string();
    findings.stops(
        "undervoltage",
        fmt::format("The motor's supply is too low: {}, below what is allowed{}.", facts.text(name), least),
        seen, supply_remedy(facts));
}

bool is_near(std::int64_t value, std::int64_t limit) {
    return limit > 0 && value * 10 >= limit * 8 && value <= limit;
}

void judge_heat(const Facts& facts, Findings& findings) {
    if (is_near(facts.at(I2T), facts.at(I2TLIM)))
        findings.hinders("i2t_near",
                         "The windings are nearly too hot, as computed: the motor will soon make itself "
                         "passive (I2T_ERR).",
                         {I2T, I2TLIM}, "Less torque, less acceleration or more pauses.");
    if (is_near(facts.at(UIT), facts.at(UITLIM)))
        findings.hinders(
            "uit_near",
            "The brake chopper is nearly too hot: the motor will soon make itself passive (UIT_ERR).",
            {UIT, UITLIM}, "Brake more gently (A_SOLL), or mount an external power dump.");
    if (facts.large() && is_near(facts.at("DEGC"), facts.at("DEGCMAX")))
        findings.hinders("hot_near", fmt::format("The motor is nearly too hot: {}.", facts.text("DEGC")),
                         {facts.number("DEGC"), facts.number("DEGCMAX")}, "Less torque, or cooling.");
    const std::string back = "The right value is the maker's, the manuals name none. " + restore_words(facts);
    if (facts.at(I2TLIM) == 0)
        findings.stops("heat_limit_zero",
                       "I2TLIM, the limit of the windings' heat, is 0: any current is too much, and the "
                       "motor makes itself passive (I2T_ERR).",
                       {I2TLIM, I2T}, back);
    if (facts.at(UITLIM) == 0)
        findings.stops("brake_limit_zero",
                       "UITLIM, the limit of the brake chopper's heat, is 0: the motor makes itself passive "
                       "as soon as it brakes (UIT_ERR).",
                       {UITLIM, UIT}, back);
}

/// Counts that a target keeps from a limit: a motor that ends on the limit itself may pass it by one.
constexpr std::int64_t kMargin = 8;
/// R: of outer samples; more than a motor lags at constant velocity.
constexpr std::int64_t kLagSamples = 3;

std::int64_t turn_of(const Facts& facts) {
    return facts.large() ? 8000 : 4096;
}

struct Room {
    std::int64_t low, high;
    bool holds(std::int64_t place) const { return place >= low && place <= high; }
};

/// What the limits leave to targets.
Room room_of(const Facts& facts) {
    const std::int64_t low = facts.at(MIN_P_IST);
    const std::int64_t high = facts.at(MAX_P_IST);
    const std::int64_t margin = std::min(kMargin, std::max<std::int64_t>(high - low, 0) / 4);
    return {low + margin, high - margin};
}

/// P_IST less what P_SOLL would be there: both count from one place, unless P_IST was written alone.
std::int64_t apart(const Facts& facts) {
    return facts.at(P_IST) + facts.at(FLWERR) - facts.at(P_FNC) / 16;
}

bool ends_inside(const Facts& facts) {
    return facts.allows(facts.at(P_SOLL));
}

/// P_SOLL for this place of P_IST, as near as the register's range allows.
std::int64_t p_soll_of(const Facts& facts, std::int64_t place) {
    const registers::Register& reg = *registers::find(facts.model(), P_SOLL);
    return std::clamp<std::int64_t>(place - apart(facts), reg.min, reg.max);
}

/// P_SOLL for another place that the limits allow: a turn on, a turn back, or as far as there is room.
std::int64_t other_target(const Facts& facts) {
    const std::int64_t here = facts.at(P_IST);
    const std::int64_t turn = turn_of(facts);
    std::int64_t place = here + turn;
    if (p_soll_of(facts, place) != place - apart(facts)) place = here - turn;
    if (facts.limited()) {
        const Room room = room_of(facts);
        if (!room.holds(place)) place = here - turn;
        if (!room.holds(place)) place = here - room.low > room.high - here ? room.low : room.high;
    }
    return p_soll_of(facts, place);
}

/// P_SOLL for where it is, or the nearest place inside.
std::int64_t target_here(const Facts& facts) {
    const Room room = room_of(facts);
    return p_soll_of(facts, std::clamp(facts.at(P_IST), room.low, std::max(room.low, room.high)));
}

/// "(it turns 4096 counts (1.00 rev) at once, to P_SOLL)"
std::string way_words(const Facts& facts, std::int64_t p_soll) {
    const registers::Register& profile = *registers::find(facts.model(), P_FNC);
    const auto way = static_cast<std::int32_t>(16 * p_soll - facts.at(P_FNC));
    if (way == 0) return "(it is at P_SOLL and will stand)";
    return fmt::format("(it turns {} at once, to P_SOLL)", long_value_text(profile, facts.model(), way));
}

std::string err_stat_command(const Facts& facts, std::int64_t set) {
    const registers::Register& reg = *registers::find(facts.model(), ERR_STAT);
    const std::int64_t settings = facts.at(ERR_STAT) & setting_bits(facts.model(), reg);
    return "ERR_STAT " + bits_word(reg, facts.model(), (settings & ~kDisPLim) | set);
}

/// That a move will have: V_SOLL, or what `why` names for one that is next to nothing.
std::int64_t velocity_of(const Facts& facts) {
    const std::int64_t set = std::abs(facts.at(facts.homes() ? V_HOME : V_SOLL));
    return set >= facts.tiny_velocity() ? set : facts.large() ? 1385 : 1049;  // 500 rpm
}

bool follow_limit_is_small(const Facts& facts) {
    return facts.at(FLWERRMAX) > 0 && facts.at(FLWERRMAX) * 16 < kLagSamples * velocity_of(facts);
}

std::string wider_follow_limit(const Facts& facts) {
    return fmt::format("FLWERRMAX {}", velocity_of(facts) / 2);
}

void judge_follow_limit(const Facts& facts, Findings& findings) {
    if (!follow_limit_is_small(facts) || facts.moves()) return;
    findings.add(facts.has_error(1) ? Severity::stops : Severity::hinders, "follow_limit_small",
                 fmt::format("FLWERRMAX ({}) is less than the way of {} samples at full velocity: a motor "
                             "that is well may pass it, and makes itself passive (FLW_ERR).",
                             facts.at(FLWERRMAX), kLagSamples),
                 {FLWERRMAX, FLWERR, facts.homes() ? V_HOME : V_SOLL},
                 fmt::format("`macreg set {}`, or less velocity; 0 is no limit.", wider_follow_limit(facts)));
}

std::string first(const std::string& command, std::string_view why) {
    return fmt::format("First `macreg set {}`: {}. Then: ", command, why);
}

std::string inside_limits(const Facts& facts) {
    if (!facts.limited()) return {};
    if (facts.gears())
        return "First stop the master: its pulses would turn the motor out of its position limits. Then: ";
    if (facts.homes())
        return first(err_stat_command(facts, kDisPLim), "the position limits act while it homes (PLIM_ERR)");
    if (facts.mode() == kAnalogueTorque)
        return first("MODE_REG INIT_MODE",
                     "torque alone would turn it out of its position limits (PLIM_ERR)");
    if (facts.positions() ? ends_inside(facts) : !facts.has_velocity_limit()) return {};
    return first(fmt::format("P_SOLL {} MODE_REG P_MODE", target_here(facts)),
                 "as it is now, it would turn until it leaves the position limits (PLIM_ERR)");
}

}  // namespace

void judge_errors(const Facts& facts, Findings& findings) {
    judge_supply(facts, findings);
    for (const Error& error : kErrors) {
        if (!is_set(facts, error.name)) continue;
        findings.stops(code_of(error.name), fmt::format("{}: {}", error.name, error.sentence),
                       numbers(facts, error.registers), remedy_of(facts, error));
    }
    judge_heat(facts, findings);
    if (is_set(facts, "IX_ERR"))
        findings.hinders("current_range",
                         "IX_ERR: a phase current was at the end of its measuring range; the current "
                         "regulator is upset or the supply too high.",
                         {ERR_STAT, facts.number("AMPLITUDE")},
                         fmt::format("Bring the filters' parameters back; less A_SOLL. Clear it: `{}`.",
                                     clear_errors_command(facts.model(), facts.at(ERR_STAT))));
    if (is_set(facts, "FRAME_ERR_TX"))
        findings.hinders("frame_errors",
                         "The motor sees framing errors on its FastMAC line: commands get lost.", {ERR_STAT},
                         "Check wiring, termination and speed of the FastMAC line (19200 baud, RS422).");
}

bool Facts::limited() const {
    return (at(MIN_P_IST) != 0 || at(MAX_P_IST) != 0) && (at(ERR_STAT) & kDisPLim) == 0;
}

bool Facts::allows(std::int64_t p_soll) const {
    return !limited() || room_of(*this).holds(p_soll + apart(*this));
}

std::string target_command(const Facts& facts, std::string_view name) {
    return fmt::format("`macreg set {} {}`", name, other_target(facts));
}

std::string start_words(const Facts& facts) {
    if (!ends_inside(facts)) {
        const std::int64_t target = other_target(facts);
        return fmt::format(
            "`macreg set P_SOLL {} MODE_REG P_MODE` {}. As it is now ({}), the target is not inside the "
            "position limits.",
            target, way_words(facts, target), facts.text(P_SOLL));
    }
    const std::string position =
        fmt::format("`macreg set MODE_REG P_MODE` {}", way_words(facts, facts.at(P_SOLL)));
    if (facts.limited())
        return position + ". Not V_MODE: it would turn on until it leaves the position limits.";
    return fmt::format("{}, or `macreg set MODE_REG V_MODE`, which turns it at once ({}).", position,
                       facts.text(V_SOLL));
}

std::string before_it_turns(const Facts& facts) {
    if (follow_limit_is_small(facts))
        return first(wider_follow_limit(facts), "a motor that is well may pass it (FLW_ERR)") +
               inside_limits(facts);
    return inside_limits(facts);
}

std::string clear_words(const Facts& facts) {
    const auto errors = static_cast<std::uint32_t>(facts.at(ERR_STAT)) & error_bits(facts.model());
    return fmt::format(
        "{}: `{}`, and choose the mode again",
        std::popcount(errors) > 1 ? "mend what led to the other errors, and clear them all" : "clear it",
        clear_errors_command(facts.model(), facts.at(ERR_STAT)));
}

std::string way_back(const Facts& facts) {
    const std::int64_t low = facts.at(MIN_P_IST);
    const std::int64_t high = facts.at(MAX_P_IST);
    const std::string clear = clear_words(facts);
    if (facts.limited() && low >= high)
        return fmt::format("Mend the limits, which leave no place, then {}.", clear);
    if (!facts.limited() || (facts.at(P_IST) >= low && facts.at(P_IST) <= high))
        return fmt::format("The shaft is inside again: {}.", clear);
    const std::string by_hand =
        fmt::format("Turn the shaft back by hand to between {} and {}, then {}.", low, high, clear);
    if (facts.mode() == kSafe) return by_hand;
    return fmt::format(
        "{} Or let the motor do it, its way being free: `macreg set P_SOLL {} {} MODE_REG P_MODE` {}, the "
        "limits being off until DIS_P_LIM is taken back.",
        by_hand, target_here(facts), err_stat_command(facts, kDisPLim), way_words(facts, target_here(facts)));
}

void judge_limits(const Facts& facts, Findings& findings) {
    judge_follow_limit(facts, findings);
    const std::int64_t low = facts.at(MIN_P_IST);
    const std::int64_t high = facts.at(MAX_P_IST);
    if (low == 0 && high == 0) return;
    const std::vector<std::uint8_t> seen{P_SOLL, P_IST, MIN_P_IST, MAX_P_IST};
    if (low >= high) {
        const std::string exchanged = low > high
                                          ? fmt::format("`macreg set MIN_P_IST {} MAX_P_IST {}`", high, low)
                                          : "`macreg set MIN_P_IST 0 MAX_P_IST 0`, or two places";
        return findings.add(facts.limited() ? Severity::stops : Severity::hinders, "limits_swapped",
                            "MIN_P_IST is not below MAX_P_IST: every position is outside, and the motor "
                            "makes itself passive (PLIM_ERR).",
                            seen, exchanged + ", the lower one smaller; both 0 is none.");
    }
    if (!facts.limited())
        return findings.tells("limits_off",
                              "DIS_P_LIM is set in ERR_STAT: MIN_P_IST and MAX_P_IST do not act.", seen,
                              "If they are to act, and P_IST is inside, take DIS_P_LIM out of ERR_STAT "
                              "(`macreg get ERR_STAT` shows what else is set).");
    if (facts.positions() && !ends_inside(facts))
        findings.hinders(
            "target_outside_limits",
            fmt::format("The target ({}) is not inside the position limits: on its way the motor makes "
                        "itself passive (PLIM_ERR).",
                        facts.text(P_SOLL)),
            seen, fmt::format("{}, for example, or wider limits; both 0 is none.", target_command(facts)));
}

}  // namespace nplc::macreg
