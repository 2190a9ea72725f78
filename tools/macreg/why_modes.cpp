#include <fmt/format.h>

#include <algorithm>

#include "macreg/change.h"
#include "macreg/values.h"
#include "why_parts.h"

namespace nplc::macreg {

using enum registers::Number;

namespace {

/// 001 §4.1.10: high above 5.4 V, low below 4.4 V. Between them it stays what it was; this is the middle.
constexpr std::int64_t kHighPercent = 49;
constexpr std::int64_t kUserInterface = 3;  // of CNTRL_BITS on MAC50 to MAC141
/// Counts by which a motor at its target may be off: more than its regulator leaves, less than one sees.
constexpr std::int64_t kApart = 64;

void judge_passive(const Facts& facts, Findings& findings) {
    const std::int64_t mode = facts.mode();
    if (mode == kSafe) {
        findings.stops("safe_mode", "The motor is in SAFE_MODE: passive, and no mode can be chosen.",
                       {MODE_REG}, "`macreg safe exit`, then choose a mode.");
    } else if (mode == kInit) {
        const bool error = (static_cast<std::uint32_t>(facts.at(ERR_STAT)) & error_bits(facts.model())) != 0;
        const char* sentence = "The motor is in INIT_MODE: passive, nobody told it to move.";
        std::string remedy = fmt::format("{} {} is the mode after power-up.", start_words(facts),
                                         registers::find(facts.model(), STARTMODE)->name);
        if (facts.gateway()) {
            sentence = "The motor is in INIT_MODE, passive: the gateway's sequence has not told it to move.";
            remedy =
                "`nanoctl status` and `nanoctl watch` show in which step the sequence is, and whether it "
                "runs.";
        }
        if (error) {
            sentence = "The motor is in INIT_MODE, passive, because of the error.";
            remedy = "When the error is cleared: " + start_words(facts);
        }
        findings.stops("passive", sentence, {MODE_REG, STARTMODE}, remedy);
    } else if (mode == kStop) {
        findings.hinders(
            "stop_mode",
            fmt::format("The motor brakes in STOP_MODE on its way to another mode ({}).", facts.text(V_IST)),
            {MODE_REG, V_IST, A_SOLL},
            "It ends below 300 rpm. If it stays, something drives the shaft, or A_SOLL is too small.");
    } else if (mode == kTestKi || mode == kTestTorque || (mode >= 7 && mode <= kBreak)) {
        findings.stops(
            "test_mode",
            fmt::format("{}: a mode of the maker's tests, which follows no velocity and no position.",
                        facts.text(MODE_REG)),
            {MODE_REG}, "`macreg set MODE_REG INIT_MODE`, then the mode that is wanted.");
    } else if (mode > kGearFollow || mode < 0) {
        findings.stops("mode_unknown", fmt::format("MODE_REG is {}, which is no mode.", mode), {MODE_REG},
                       "`macreg set MODE_REG INIT_MODE`, then the mode that is wanted.");
    }
}

void judge_demands(const Facts& facts, Findings& findings) {
    // In INIT_MODE it is for the mode that will be chosen; a gateway's sequence sets what it needs.
    const bool will_be = facts.mode() == kInit && !facts.gateway();
    if ((!facts.is_driven() && !will_be) || facts.mode() == kStop) return;
    if (facts.mode() != kHome1 && facts.at(T_SOLL) == 0)
        findings.stops("torque_zero", "T_SOLL, the torque that the motor may use, is 0.", {T_SOLL},
                       "`macreg set T_SOLL 100%`, or less if the machine takes less.");
    if (facts.at(A_SOLL) == 0)
        findings.stops("acceleration_zero", "A_SOLL, the acceleration, is 0: the velocity can never change.",
                       {A_SOLL}, "`macreg set A_SOLL 10000rpm/s`, for example.");
    if (!facts.has_velocity_limit() && !will_be) return;
    const std::int64_t v = std::abs(facts.at(V_SOLL));
    const bool by_supply = (facts.at("UV_HANDLE") & (facts.large() ? 4 : 8)) != 0;
    if (v == 0)
        findings.stops("velocity_zero", "V_SOLL, the velocity or its limit, is 0.",
                       {V_SOLL, facts.number("UV_HANDLE")},
                       by_supply ? "`macreg set V_SOLL 500rpm`, for example. UV_HANDLE lets undervoltage set "
                                   "it to 0: look at the supply."
                                 : "`macreg set V_SOLL 500rpm`, for example.");
    else if (v < facts.tiny_velocity())
        findings.hinders(
            "velocity_tiny", fmt::format("{} is so slow that it looks like standing.", facts.text(V_SOLL)),
            {V_SOLL}, "`macreg set V_SOLL 500rpm`; without unit a number is raw steps, not rpm.");
}

void judge_target(const Facts& facts, Findings& findings) {
    if (!facts.positions()) return;
    // P_FNC, not P_IST, is where the profile is: FLWERR lies between (001 §4.4.3).
    const auto distance = static_cast<std::int32_t>(16 * facts.at(P_SOLL) - facts.at(P_FNC));
    if (distance != 0 || facts.moves()) return;
    const std::int64_t off = static_cast<std::int32_t>(facts.at(P_SOLL) - facts.at(FLWERR) - facts.at(P_IST));
    if (std::abs(off) > kApart) {
        const registers::Register& profile = *registers::find(facts.model(), P_FNC);
        return findings.stops(
            "profile_apart",
            fmt::format("The motor's profile has reached the target ({}), but by P_IST the shaft is "
                        "elsewhere ({}): {} and P_IST count from different places. P_IST was written alone, "
                        "or positions were chosen relatively (RELPOSPFNC).",
                        facts.text(P_SOLL), facts.text(P_IST), profile.name),
            {P_SOLL, P_FNC, P_IST, FLWERR},
            fmt::format("It will not go there by itself. To go on from here with one count for all: `{}`; "
                        "the shaft does not turn by it.",
                        resynchronise_command(facts.model(), facts.at(CNTRL_BITS), facts.at(P_IST))));
    }
    if (std::abs(facts.at(FLWERR)) > kApart)
        return findings.stops(
            "lags",
            fmt::format("The motor's profile has reached the target ({}), but the shaft stands {} from it.",
                        facts.text(P_SOLL), facts.text(FLWERR)),
            {P_SOLL, P_IST, FLWERR, T_SOLL, facts.number("VF_OUT")},
            "Something holds the shaft, or T_SOLL is too small for it: free it, or allow more torque.");
    std::string remedy = fmt::format(
        "Give it another target: {}, for example, or P_REG_P for one of P1 to P8.", target_command(facts));
    const char* code = "at_target";
    if (facts.mode() == kAnalogue2Position && facts.at("P1") == facts.at("P2")) {
        code = "positions_equal";
        remedy = fmt::format("P1 and P2 are one place, so no level moves it: {}, for example.",
                             target_command(facts, "P2"));
    } else if (facts.mode() == kAnaloguePosition && facts.at("P2") == 0) {
        code = "range_zero";
        remedy =
            "P2 is 0, so no voltage moves it: `macreg set P2 10`, for example (10 V then go 640 counts from "
            "P1, 1280 on a MAC800).";
    } else if (facts.mode() == kAnaloguePosition &&
               std::abs(facts.at("P2")) * facts.full_voltage() / 16 <= facts.at("P3")) {
        code = "dead_band_wide";
        remedy =
            "P3, the dead band, is as wide as all that P2 lets a voltage do: `macreg set P3 0`, or a larger "
            "P2.";
    } else if (facts.mode() == kAnalogue2Position) {
        code = "waits_for_level";
        remedy = "It goes to the other position (P1, P2) when the level at the analogue input changes.";
    } else if (facts.mode() == kAnaloguePosition) {
        code = "waits_for_voltage";
        remedy =
            "The voltage at the analogue input chooses the target; 10 V go 64 times P2 from P1 (128 times on "
            "a MAC800), P3 is the dead band.";
    }
    findings.stops(
        code,
        fmt::format("The motor is where it should be: its profile has reached the target ({}, {}).",
                    facts.text(P_SOLL), facts.text(P_IST)),
        {P_SOLL, P_FNC, P_IST, facts.number("ANINP")}, remedy);
}

void judge_gear(const Facts& facts, Findings& findings) {
    const bool gear = facts.gears() || facts.mode() == kAnalogueVelocityGear;
    if (!gear) return;
    if (facts.at(GEARF1) == 0)
        findings.stops("gear_zero", "GEARF1 is 0: the motor follows the pulses with 0 times their speed.",
                       {GEARF1, GEARF2}, "`macreg set GEARF1 1`; GEARF1 / GEARF2 is the ratio.");
    if (facts.at(GEARF2) == 0)
        findings.stops("gear_denominator_zero", "GEARF2 is 0: the gear ratio GEARF1 / GEARF2 is none.",
                       {GEARF1, GEARF2}, "`macreg set GEARF2 1`.");
    const std::int64_t pulses = facts.at("V_EXT") + (facts.mode() == kCoil ? facts.at("V8") : 0);
    const bool by_voltage =
        facts.mode() == kAnalogueVelocityGear && facts.at("ANINP") * 100 / facts.full_voltage() != 0;
    if (pulses != 0 || facts.before(facts.number("V_EXT")) != 0 || by_voltage) return;
    if (!facts.large() && ((facts.at(CNTRL_BITS) & kUserInterface) != 0 || facts.speaks_fastmac()))
        findings.stops("pulse_pins_taken",
                       "The motor is to follow pulses, but the pins of the pulse input serve something else "
                       "(USERINTF is not 00, or was not at the last reset).",
                       {CNTRL_BITS, facts.number("V_EXT")},
                       fmt::format("`{}`, then {}: it counts from a reset on. The pins are FastMAC's then no "
                                   "more: a PLC or a gateway that is wired to them loses the motor.",
                                   control_command(facts.model(), facts.at(CNTRL_BITS), 0, kUserInterface),
                                   facts.service("macreg flash save")));
    else
        findings.stops(
            "no_pulses", "The motor is to follow pulses, and none come (V_EXT is 0).",
            {facts.number("V_EXT"), CNTRL_BITS},
            facts.large()
                ? "Turn the master; check the wiring."
                : fmt::format("Turn the master; check the wiring and the format (PULSEDIR: pulse and "
                              "direction, else quadrature). If USERINTF was set after the last reset, the "
                              "pins are not those of the pulse input yet: {} keeps it and resets.",
                              facts.service("macreg flash save")));
}

void judge_coil(const Facts& facts, Findings& findings) {
    if (facts.mode() != kCoil) return;
    const std::int64_t p1 = facts.at(P1), p2 = facts.at("P2"), p3 = facts.at("P3"), p4 = facts.at("P4");
    if (p1 > p2 || p2 > p3 || p3 > p4 || p1 == p4)
        findings.stops(
            "coil_setup",
            "The coil's setup is none: P1 <= P2 <= P3 <= P4 with P1 below P4 must hold (001 4.4.20).",
            {P1, facts.number("P2"), facts.number("P3"), facts.number("P4")},
            "Set P1 to P4: thread left, stop left, stop right, thread right; inside the position limits, if "
            "there are any.");
    else if (!facts.allows(p1) || !facts.allows(p4))
        findings.stops("coil_outside_limits",
                       "The coil's way is not inside the position limits: the motor makes itself passive on "
                       "it (PLIM_ERR).",
                       {P1, facts.number("P4"), MIN_P_IST, MAX_P_IST},
                       "Set P1 to P4 inside, or widen the limits.");
    else if (!facts.moves() && facts.at("FNC_OUT") == 0)
        findings.hinders(
            "coil_waits",
            "The coil waits: a high level at the analogue input sends it to its start (P5), and after it low "
            "lets it wind.",
            {facts.number("ANINP"), facts.number("P5")},
            "Give a start position command once after power-up and homing; then turn the spool.");
}

/// 001 §4.1.10, §4.1.11: where the analogue input can send it.
void judge_reach(const Facts& facts, Findings& findings) {
    const std::int64_t p1 = facts.at("P1"), p2 = facts.at("P2");
    const std::int64_t reach = facts.full_voltage() * p2 / 16;
    const bool inside = facts.mode() == kAnaloguePosition
                            ? facts.allows(p1 - reach) && facts.allows(p1 + reach)
                            : facts.allows(p1) && facts.allows(p2);
    if ((facts.mode() != kAnaloguePosition && facts.mode() != kAnalogue2Position) || inside) return;
    findings.stops("voltage_outside_limits",
                   "The voltage at the analogue input can send the motor out of its position limits, where "
                   "it makes itself passive (PLIM_ERR).",
                   {P1, facts.number("P2"), MIN_P_IST, MAX_P_IST},
                   "Choose P1 and P2 so that all they reach is inside, or widen the limits.");
}

void judge_analogue(const Facts& facts, Findings& findings) {
    const std::int64_t mode = facts.mode();
    const std::int64_t volts = facts.at("ANINP");
    const std::uint8_t aninp = facts.number("ANINP");
    constexpr const char* kRaise =
        "Raise the voltage at the analogue input (up to 10 V either way); check its wiring and ANINP_OFFSET.";
    const std::int64_t small = facts.full_voltage() / 100;  // 0.1 V
    if ((mode == kAnalogueTorque || mode == kAnalogueVelocity) && std::abs(volts) <= small)
        findings.stops(
            "analogue_zero",
            fmt::format("{} follows the voltage at the analogue input, and there is hardly any: {}.",
                        facts.text(MODE_REG), facts.text(aninp)),
            {aninp, MODE_REG}, kRaise);
    if (mode == kAnalogueVelocityZero && std::abs(volts) <= 64 * (facts.large() ? 2 : 1))
        findings.stops(
            "analogue_dead_band",
            fmt::format("The voltage at the analogue input is inside the dead band: {}.", facts.text(aninp)),
            {aninp}, kRaise);
    if (mode == kVelocityAnalogueTorque && facts.at(T_SOLL) != 0 && facts.torque_limit() == 0)
        findings.stops(
            "analogue_torque_zero",
            fmt::format("The voltage at the analogue input is the torque limit, and there is hardly any: {}.",
                        facts.text(aninp)),
            {aninp, T_SOLL}, kRaise);
}

void judge_homing(const Facts& facts, Findings& findings) {
    if (!facts.homes()) return;
    if (facts.at(V_HOME) == 0)
        findings.stops("home_velocity_zero", "The motor homes, but V_HOME, the velocity of it, is 0.",
                       {V_HOME}, "`macreg set V_HOME -200rpm`, for example; its sign is the direction.");
    const std::uint8_t aninp = facts.number("ANINP");
    if (facts.mode() != kHome1) {
        const bool high = facts.at(aninp) * 100 > facts.full_voltage() * kHighPercent;
        const bool active_high = facts.at(T_HOME) >= 0;
        return findings.hinders(
            "homing_switch",
            fmt::format("The motor homes and waits for its switch at the analogue input, which counts as on "
                        "when {} (sign of T_HOME); it is {} now: {}.",
                        active_high ? "high" : "low", high ? "high" : "low", facts.text(aninp)),
            {MODE_REG, aninp, T_HOME, V_HOME},
            "If it never comes: check switch, wiring and the signs of T_HOME and V_HOME. INIT_MODE ends the "
            "search.");
    }
    if (facts.at(T_HOME) == 0)
        findings.stops("home_torque_zero",
                       "The motor homes against a stop, but T_HOME, the torque for it, is 0.", {T_HOME},
                       "`macreg set T_HOME 30%`, for example.");
    findings.hinders(
        "homing_stop",
        fmt::format("The motor homes until it meets a mechanical stop with {}; {} now.", facts.text(T_HOME),
                    facts.text("VF_OUT")),
        {MODE_REG, T_HOME, V_HOME, facts.number("VF_OUT")},
        "If it stands before its stop, T_HOME is too small for the friction; INIT_MODE ends the search.");
}

}  // namespace

void judge_modes(const Facts& facts, Findings& findings) {
    judge_passive(facts, findings);
    judge_demands(facts, findings);
    judge_target(facts, findings);
    judge_gear(facts, findings);
    judge_coil(facts, findings);
    judge_reach(facts, findings);
    judge_analogue(facts, findings);
    judge_homing(facts, findings);
}

}  // namespace nplc::macreg
