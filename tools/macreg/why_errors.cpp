#include <fmt/format.h>

#include <array>
#include <span>

#include "macreg/change.h"
#include "registers/details.h"
#include "why_parts.h"

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
        findings.push_back(
            {"undervoltage_recent",
             Severity::hinders,
             fmt::format("The supply was too low a moment ago; it is {} now.", facts.text(name)),
             {ERR_STAT, facts.number(name), facts.number("U_MIN_SUP")},
             "Ask again in a second; if it comes back, the supply sags under load."});
        return;
    }
    std::vector<std::uint8_t> seen{ERR_STAT, facts.number(name)};
    if (facts.knows("U_MIN_SUP")) seen.push_back(facts.number("U_MIN_SUP"));
    const std::string least =
        facts.knows("U_MIN_SUP") ? fmt::format(" ({})", facts.text("U_MIN_SUP")) : std::string();
    findings.push_back(
        {"undervoltage", Severity::stops,
         fmt::format("The motor's supply is too low: {}, below what is allowed{}.", facts.text(name), least),
         seen, supply_remedy(facts)});
}

bool is_near(std::int64_t value, std::int64_t limit) {
    return limit > 0 && value * 10 >= limit * 8 && value <= limit;
}

void judge_heat(const Facts& facts, Findings& findings) {
    if (is_near(facts.at(I2T), facts.at(I2TLIM)))
        findings.push_back({"i2t_near",
                            Severity::hinders,
                            "The windings are nearly too hot, as computed: the motor will soon make itself "
                            "passive (I2T_ERR).",
                            {I2T, I2TLIM},
                            "Less torque, less acceleration or more pauses."});
    if (is_near(facts.at(UIT), facts.at(UITLIM)))
        findings.push_back(
            {"uit_near",
             Severity::hinders,
             "The brake chopper is nearly too hot: the motor will soon make itself passive (UIT_ERR).",
             {UIT, UITLIM},
             "Brake more gently (A_SOLL), or mount an external power dump."});
    if (facts.large() && is_near(facts.at("DEGC"), facts.at("DEGCMAX")))
        findings.push_back({"hot_near",
                            Severity::hinders,
                            fmt::format("The motor is nearly too hot: {}.", facts.text("DEGC")),
                            {facts.number("DEGC"), facts.number("DEGCMAX")},
                            "Less torque, or cooling."});
    const std::string back = "The right value is the maker's, the manuals name none. " + restore_words(facts);
    if (facts.at(I2TLIM) == 0)
        findings.push_back(
            {"heat_limit_zero",
             Severity::stops,
             "I2TLIM, the limit of the windings' heat, is 0: any current is too much, and the motor "
             "makes itself passive (I2T_ERR).",
             {I2TLIM, I2T},
             back});
    if (facts.at(UITLIM) == 0)
        findings.push_back(
            {"brake_limit_zero",
             Severity::stops,
             "UITLIM, the limit of the brake chopper's heat, is 0: the motor makes itself passive as "
             "soon as it brakes (UIT_ERR).",
             {UITLIM, UIT},
             back});
}

}  // namespace

void judge_errors(const Facts& facts, Findings& findings) {
    judge_supply(facts, findings);
    for (const Error& error : kErrors) {
        if (!is_set(facts, error.name)) continue;
        findings.push_back({code_of(error.name), Severity::stops,
                            fmt::format("{}: {}", error.name, error.sentence),
                            numbers(facts, error.registers), remedy_of(facts, error)});
    }
    judge_heat(facts, findings);
    if (is_set(facts, "IX_ERR"))
        findings.push_back(
            {"current_range",
             Severity::hinders,
             "IX_ERR: a phase current was at the end of its measuring range; the current regulator is upset "
             "or the "
             "supply too high.",
             {ERR_STAT, facts.number("AMPLITUDE")},
             fmt::format("Bring the filters' parameters back; less A_SOLL. Clear it: `{}`.",
                         clear_errors_command(facts.model(), facts.at(ERR_STAT)))});
    if (is_set(facts, "FRAME_ERR_TX"))
        findings.push_back({"frame_errors",
                            Severity::hinders,
                            "The motor sees framing errors on its FastMAC line: commands get lost.",
                            {ERR_STAT},
                            "Check wiring, termination and speed of the FastMAC line (19200 baud, RS422)."});
}

}  // namespace nplc::macreg
