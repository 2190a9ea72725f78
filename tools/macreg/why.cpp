#include "macreg/why.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "base/bytes.h"
#include "macreg/change.h"
#include "macreg/values.h"
#include "registers/gateway.h"
#include "why_parts.h"

// Which cause is told first, and what stands before a remedy.
namespace nplc::macreg {

namespace gw = registers::gateway;
using enum registers::Number;

namespace {

constexpr base::Milliseconds kBetween{200};
/// Counts between two looks that encoder noise does not make.
constexpr std::int64_t kMotion = 8;

constexpr std::string_view kJudged[] = {
    "MODE_REG",  "P_SOLL",     "V_SOLL",    "A_SOLL",    "T_SOLL",    "P_FNC",     "P_IST",     "V_IST",
    "KVOUT",     "GEARF1",     "GEARF2",    "I2T",       "I2TLIM",    "UIT",       "UITLIM",    "FLWERR",
    "FLWERRMAX", "FNCERR",     "FNCERRMAX", "MIN_P_IST", "MAX_P_IST", "ACC_EMERG", "ERR_STAT",  "CNTRL_BITS",
    "STARTMODE", "START_MODE", "V_HOME",    "T_HOME",    "HOME_MODE", "P_REG_P",   "V_REG_P",   "A_REG_P",
    "T_REG_P",   "L_REG_P",    "Z_REG_P",   "P1",        "P2",        "P3",        "P4",        "P5",
    "P6",        "V8",         "KFF0",      "KFF1",      "KFF2",      "KFF3",      "KFF4",      "KFF5",
    "KVFX1",     "KVFX2",      "KVFX3",     "KVFX4",     "KVFX5",     "KVFX6",     "KIFX1",     "KIFX2",
    "FNC_OUT",   "V_EXT",      "VF_OUT",    "ANINP",     "AMPLITUDE", "U_SUPPLY",  "U_MIN_SUP", "UV_HANDLE",
    "U_24V",     "DEGC",       "DEGCMAX",   "U_BUS"};

std::vector<const registers::Register*> judged(registers::Model model) {
    std::vector<const registers::Register*> all;
    for (const std::string_view name : kJudged) {
        const registers::Register* reg = registers::find(model, name);
        if (reg != nullptr && std::find(all.begin(), all.end(), reg) == all.end()) all.push_back(reg);
    }
    return all;
}

void judge_gateway(const Facts& facts, Findings& findings) {
    if (!facts.gateway()) return;
    const auto& [status, reason] = *facts.gateway();
    const auto state = gw::run_state_of(status);
    if ((status & gw::kLinkDelivers) == 0)
        findings.stops(
            "gateway_link_down",
            "The gateway's FastMAC link to the motor does not work, so no order of the sequence arrives.", {},
            "`nanoctl status` and `nanoctl log` tell more; mend the line, or run `macreg prepare` on the "
            "motor's own port.");
    if (state == gw::RunState::stopped)
        findings.add(facts.moves() ? Severity::hinders : Severity::stops, "gateway_stopped",
                     "The gateway's sequence is stopped, so it gives the motor no orders.", {},
                     "`nanoctl run` starts it.");
    else if (state == gw::RunState::held || state == gw::RunState::holding)
        findings.stops("gateway_held", "The gateway's sequence is held, the motor stopped.", {},
                       "`nanoctl run` lets it go on, `nanoctl step` goes a step.");
    else
        findings.tells(
            "gateway_runs",
            "The gateway's sequence runs and orders the motor's modes and targets: what is set here it may "
            "set again.",
            {}, "`nanoctl watch` shows which step it waits in; `nanoctl stop` before setting anything here.");
    if ((status & gw::kSafe) != 0)
        findings.add(facts.moves() ? Severity::hinders : Severity::stops, "gateway_safe",
                     fmt::format("The gateway is in its safe state (reason {}).", reason), {},
                     "`nanoctl status` names the reason and what ends it.");
}

/// With the torque at its limit, no motion, and an error that grows: something holds the shaft.
void judge_torque(const Facts& facts, Findings& findings) {
    const std::int64_t limit = facts.torque_limit();
    const std::int64_t torque = std::abs(facts.at("VF_OUT"));
    if (limit <= 0 || torque < limit - limit / 32 || facts.moves()) return;
    const auto grows = [&](std::uint8_t number) {
        return std::abs(facts.at(number)) > std::abs(facts.before(number));
    };
    const bool held_back = facts.gears() && facts.at(FNCERR) != 0;  // G_FNC there, which may stand
    if (!grows(FLWERR) && !grows(FNCERR) && !held_back) return;
    const std::uint8_t reg = facts.mode() == kHome1 ? T_HOME : T_SOLL;
    std::vector<std::uint8_t> seen{facts.number("VF_OUT"), reg, FLWERR, FNCERR, V_IST};
    if (limit >= 1000) {
        findings.stops("blocked",
                       fmt::format("The motor pushes with its full torque ({}) and stands: its shaft is "
                                   "blocked, or the load is too heavy.",
                                   facts.text("VF_OUT")),
                       seen,
                       "Free the shaft; look for a holding brake, a mechanical stop, a wrong direction.");
        return;
    }
    findings.stops(
        "torque_too_small",
        fmt::format("The motor pushes with all the torque it may use ({}) and stands.", facts.text(reg)),
        seen, "Free the shaft, or allow more torque: `macreg set T_SOLL 100%` if the machine may take it.");
}

/// Registers of the regulator: if all of a row are 0, nothing turns the shaft.
struct RegulatorPart {
    const char* code;
    std::array<std::string_view, 6> registers;
    const char* sentence;
};

constexpr RegulatorPart kRegulator[] = {
    {"amplitude_zero", {"AMPLITUDE"}, "AMPLITUDE is 0, so no current flows in the windings."},
    {"regulator_zero",
     {"KVFX1", "KVFX2", "KVFX3", "KVFX4", "KVFX5", "KVFX6"},
     "All numerators of the speed regulator (KVFX) are 0: it never asks for torque."},
    {"profile_filter_zero",
     {"KFF0", "KFF1", "KFF2", "KFF3", "KFF4", "KFF5"},
     "All coefficients of the profile's filter (KFF) are 0: no velocity gets through it."},
    {"current_regulator_zero",
     {"KIFX1", "KIFX2"},
     "The current regulator's numerators (KIFX) are 0: no voltage reaches the windings."},
};

void judge_regulator(const Facts& facts, Findings& findings) {
    if (facts.at(KVOUT) == 0)
        findings.stops(
            "load_factor_zero",
            "KVOUT, the load factor, is 0: the torque that the regulator asks for is multiplied by it.",
            {KVOUT},
            facts.is_passive() ? "`macreg set KVOUT 1`, more with inertia at the shaft."
                               : "`macreg set MODE_REG INIT_MODE KVOUT 1`, more with inertia at the shaft; "
                                 "then choose the mode again.");
    for (const RegulatorPart& part : kRegulator) {
        const bool zero =
            std::all_of(part.registers.begin(), part.registers.end(),
                        [&](std::string_view name) { return !facts.knows(name) || facts.at(name) == 0; });
        if (zero)
            findings.stops(part.code, part.sentence, {facts.number(part.registers[0])}, restore_words(facts));
    }
}

void judge_pointers(const Facts& facts, Findings& findings) {
    constexpr std::uint8_t kPointers[] = {P_REG_P, V_REG_P, A_REG_P, T_REG_P, L_REG_P, Z_REG_P};
    for (const std::uint8_t number : kPointers) {
        if (facts.at(number) == 0) continue;
        const std::string name(registers::find(facts.model(), number)->name);
        findings.hinders(
            "pointer_stuck",
            fmt::format("{} is {}, and there is no register of that number: nothing was selected.", name,
                        facts.at(number)),
            {number},
            fmt::format("`macreg set {} 0` ends it, and nothing is selected; 8 is the most for P and V, 4 "
                        "for the others.",
                        name));
    }
}

/// CNTRL_BITS may have been written after the last reset, from which on it counts (001 §3.2.36).
void judge_link(const Facts& facts, Findings& findings) {
    if (facts.large()) return;
    const bool asked_for = (facts.at(CNTRL_BITS) & 3) == 3;
    const bool counts = facts.counts_pulses();
    if (asked_for ? counts : facts.speaks_fastmac()) {
        findings.tells("user_interface_waits",
                       fmt::format("CNTRL_BITS asks for another user interface than the one that acts: it "
                                   "counts from a reset on, and the pins are still those of {}.",
                                   counts ? "the pulse input" : "FastMAC"),
                       {CNTRL_BITS, facts.number("V_EXT")},
                       fmt::format("If it is to act: {} keeps it and resets the motor.",
                                   facts.service("macreg flash save")));
        return;
    }
    if (!asked_for || facts.gateway()) return;
    findings.tells(
        "fastmac_owns",
        "The user interface is set to FastMAC, which acts if it was so at the last reset: whoever is wired "
        "to it (an expansion module, a PLC) may set modes and targets at any time.",
        {CNTRL_BITS},
        fmt::format(
            "If values change by themselves, stop that one first; {} makes the motor passive and deaf to it.",
            facts.service("macreg safe enter")));
}

void tell_unknown(const Facts& facts, Findings& findings) {
    findings.tells(
        "unknown",
        fmt::format("Nothing is found that keeps the motor from moving: {}, no error, and all that this mode "
                    "needs is there.",
                    facts.text(MODE_REG)),
        {MODE_REG, P_SOLL, P_IST, V_SOLL, A_SOLL, T_SOLL, V_IST, facts.number("VF_OUT"), ERR_STAT},
        fmt::format("Watch what it does: `macreg watch MODE_REG P_SOLL {} P_IST V_IST VF_OUT FLWERR`.",
                    registers::find(facts.model(), P_FNC)->name));
}

void judge_motion(const Facts& facts, Findings& findings) {
    if (!facts.moves()) return;
    const std::uint8_t asked = facts.homes() ? V_HOME : V_SOLL;
    if (facts.runs_away())
        findings.stops(
            "runaway",
            fmt::format("CUT ITS POWER: the motor turns much faster than {} asks for ({}, {}), and does not "
                        "slow down.",
                        facts.text(MODE_REG), facts.text(V_IST), facts.text(asked)),
            {MODE_REG, V_IST, asked, P_IST, FLWERR, facts.number("VF_OUT")},
            "A stop by the line may not stop it. Then find out what drives it: a load, or filters, signs and "
            "rotor angle that make the regulator drive the wrong way (parameters of another motor).");
    else if (facts.is_passive())
        findings.tells(
            "moves",
            fmt::format("The shaft turns although the motor is passive ({}): something else turns it.",
                        facts.text(V_IST)),
            {V_IST, P_IST},
            "Look what drives the shaft: a hanging load, a belt, or the way of a motor that was switched "
            "off.");
    else
        findings.tells(
            "moves", fmt::format("It moves: {}.", facts.text(V_IST)), {V_IST, P_IST},
            "If that is as wanted, there is nothing to mend; if the machine stands, look at the coupling.");
}

constexpr std::string_view kMoves[] = {"runaway", "moves"};

/// In the order in which they are to be mended: nothing that stands here helps while one before it is there.
constexpr std::string_view kOrder[] = {
    // no power, no line
    "gateway_link_down", "undervoltage",
    // what would bring an error back, or makes torque impossible
    "limits_swapped", "heat_limit_zero", "brake_limit_zero", "follow_limit_small", "load_factor_zero",
    "amplitude_zero", "regulator_zero", "profile_filter_zero", "current_regulator_zero", "error_old_filt_err",
    "error_index_err", "error_u24v_err", "torque_zero",
    // errors that are held
    "error_plim_err", "error_i2t_err", "error_uit_err", "error_flw_err", "error_fnc_err", "error_uv_err",
    "error_degc_err", "error_ov_err", "error_ipeak_err", "error_speed_err",
    // who gives the orders
    "gateway_safe", "gateway_held", "gateway_stopped", "mode_unknown", "test_mode",
    // what the order is made of
    "acceleration_zero", "velocity_zero", "home_velocity_zero", "home_torque_zero", "gear_zero",
    "gear_denominator_zero", "pulse_pins_taken", "coil_setup", "coil_outside_limits",
    "voltage_outside_limits", "no_pulses", "analogue_zero", "analogue_dead_band", "analogue_torque_zero",
    // the order
    "safe_mode", "passive", "profile_apart",
    // what holds the shaft
    "blocked", "torque_too_small", "lags", "positions_equal", "range_zero", "dead_band_wide", "at_target",
    "waits_for_level", "waits_for_voltage", "coil_waits", "homing_switch", "homing_stop"};

/// Whose remedy lets the motor turn as its mode asks for.
constexpr std::string_view kLetTurn[] = {"torque_zero",
                                         "acceleration_zero",
                                         "velocity_zero",
                                         "velocity_tiny",
                                         "home_velocity_zero",
                                         "home_torque_zero",
                                         "gear_zero",
                                         "gear_denominator_zero",
                                         "analogue_zero",
                                         "analogue_dead_band",
                                         "analogue_torque_zero",
                                         "no_pulses",
                                         "coil_setup",
                                         "coil_outside_limits",
                                         "voltage_outside_limits",
                                         "error_plim_err",
                                         "passive",
                                         "at_target",
                                         "positions_equal",
                                         "range_zero",
                                         "dead_band_wide",
                                         "waits_for_level",
                                         "waits_for_voltage",
                                         "coil_waits"};
/// Whose remedy frees a shaft that the motor pushes.
constexpr std::string_view kFree[] = {"blocked", "torque_too_small", "lags"};

bool among(std::span<const std::string_view> codes, std::string_view code) {
    return std::find(codes.begin(), codes.end(), code) != codes.end();
}

/// What is in no list comes after what is, as it was found.
std::ptrdiff_t rank_of(const Finding& finding) {
    if (among(kMoves, finding.code)) return -1;
    return std::find(std::begin(kOrder), std::end(kOrder), finding.code) - std::begin(kOrder);
}

bool names(const Finding& finding, std::initializer_list<std::string_view> commands) {
    return std::any_of(commands.begin(), commands.end(), [&](std::string_view command) {
        return finding.remedy.find(command) != std::string::npos;
    });
}

}  // namespace

std::string restore_words(const Facts& facts) {
    return fmt::format(
        "Bring the parameters back: those in the flash by {}, or a file of an earlier dump; as the last "
        "resort {}, which loses all that was set.",
        facts.service("macreg flash reload"), facts.service("macreg flash defaults"));
}

std::string Facts::text(std::uint8_t number) const {
    const registers::Register* reg = registers::find(model(), number);
    return reg == nullptr ? std::string()
                          : fmt::format("{} {}", reg->name, long_value_text(*reg, model(), at(number)));
}

std::string Facts::service(std::string_view command) const {
    return fmt::format("`{}{}`", command, is_passive() ? "" : " --stop");
}

bool Facts::moves() const {
    return std::abs(at(P_IST) - before(P_IST)) >= kMotion && (at(V_IST) != 0 || before(V_IST) != 0);
}

bool Facts::runs_away() const {
    // The pulse input is another source of velocity there (001 §3.2.5).
    if (!is_driven() || mode() == kAnalogueVelocityGear || mode() == kGearFollow || mode() == kCoil)
        return false;
    const std::int64_t now = 16 * std::abs(at(V_IST));
    const std::int64_t before_that = 16 * std::abs(before(V_IST));
    constexpr std::int64_t kNoise = 16 * 2;
    if (now < before_that - std::max(kNoise, before_that / 32)) return false;  // it brakes
    const std::int64_t asked = mode() == kStop ? 0 : std::abs(at(homes() ? V_HOME : V_SOLL));
    // The profile may be on its way down still: P_FNC's pace is what it asks for now.
    const std::int64_t pace = std::abs(static_cast<std::int32_t>(at(P_FNC) - before(P_FNC)));
    const std::int64_t way = 16 * std::abs(static_cast<std::int32_t>(at(P_IST) - before(P_IST)));
    const bool follows = mode() != kStop && way <= pace + pace / 4;
    const std::int64_t margin = large() ? 831 : 629;  // 300 rpm: 2.77056 and 2.09715 a rpm
    return !follows && now > 2 * asked + margin;
}

bool Facts::speaks_fastmac() const {
    return !large() && gateway() && (gateway()->status & gw::kLinkDelivers) != 0;
}

bool Facts::counts_pulses() const {
    // Other modes leave V_EXT as it was (001 §3.2.120).
    if (mode() != kInit && !gears() && mode() != kAnalogueVelocityGear) return false;
    return mode() != kCoil && (at("V_EXT") != 0 || before(number("V_EXT")) != 0);
}

bool Facts::gears() const {
    return mode() == kGearPosition || mode() == kAnalogueGear || mode() == kCoil || mode() == kGearFollow;
}

bool Facts::positions() const {
    return mode() == kPosition || mode() == kAnalogue2Position || mode() == kAnaloguePosition;
}

bool Facts::has_velocity_limit() const {
    return positions() || gears() || mode() == kVelocity || mode() == kAnalogueVelocity ||
           mode() == kAnalogueVelocityGear || mode() == kAnalogueVelocityZero ||
           mode() == kVelocityAnalogueTorque;
}

bool Facts::is_driven() const {
    return has_velocity_limit() || homes() || mode() == kStop;
}

std::int64_t Facts::torque_limit() const {
    if (!is_driven()) return 0;
    if (mode() == kStop) return 1023;
    if (mode() == kHome1) return std::min<std::int64_t>(std::abs(at(T_HOME)) * 5 / 4, 1023);
    if (mode() != kVelocityAnalogueTorque) return std::abs(at(T_SOLL));
    return std::abs(at("ANINP") * at(T_SOLL)) / (full_voltage() + 1);
}

Condition read_condition(Motor& motor, bool look_for_gateway) {
    Condition condition{.model = motor.model()};
    const auto wanted = judged(motor.model());
    condition.before = motor.read_block(wanted);
    motor.master().pause(kBetween);
    condition.now = motor.read_block(wanted);
    if (!look_for_gateway || !motor.is_behind_gateway()) return condition;
    const auto block = motor.master().read_block(gw::kDefaultAddress, gw::STATUS);
    condition.gateway = {.status = base::load_u32(block.data()), .safe_reason = base::load_u32(&block[4])};
    return condition;
}

std::vector<Finding> why(const Condition& condition) {
    const Facts facts(condition);
    Findings findings;
    judge_motion(facts, findings);
    judge_errors(facts, findings);
    judge_gateway(facts, findings);
    judge_modes(facts, findings);
    judge_limits(facts, findings);
    judge_regulator(facts, findings);
    judge_torque(facts, findings);
    judge_pointers(facts, findings);
    judge_link(facts, findings);
    const auto says_why = [](const Finding& one) {
        return one.severity != Severity::tells || one.code == "moves" || one.code == "runaway";
    };
    if (std::none_of(findings.all.begin(), findings.all.end(), says_why)) tell_unknown(facts, findings);
    begin_safely(facts, findings);
    pass_gateway(facts, findings);
    sort_by_rank(findings);
    return std::move(findings.all);
}

void sort_by_rank(Findings& findings) {
    std::stable_sort(findings.all.begin(), findings.all.end(), [](const Finding& a, const Finding& b) {
        const bool moves_a = among(kMoves, a.code), moves_b = among(kMoves, b.code);
        if (moves_a != moves_b) return moves_a;
        if (a.severity != b.severity) return a.severity < b.severity;
        return rank_of(a) < rank_of(b);
    });
}

void begin_safely(const Facts& facts, Findings& findings) {
    if (facts.moves()) return;
    for (Finding& one : findings.all) {
        if (among(kLetTurn, one.code)) one.remedy.insert(0, before_it_turns(facts));
        if (among(kFree, one.code))
            one.remedy.insert(0,
                              "First `macreg set MODE_REG INIT_MODE`: it pushes, and would jump as soon as "
                              "it can turn (hold a hanging load, which falls by that). Then: ");
    }
}

void pass_gateway(const Facts& facts, Findings& findings) {
    if (!facts.gateway()) return;
    const bool stopped = gw::run_state_of(facts.gateway()->status) == gw::RunState::stopped;
    for (Finding& one : findings.all) {
        if (!stopped && names(one, {"`macreg set"}))
            one.remedy.insert(0,
                              "First `nanoctl stop`: while its sequence runs or is held, the gateway lets no "
                              "write through unless its setting motor_writes says so. Then: ");
        if (names(one, {"`macreg flash", "`macreg safe"}))
            one.remedy +=
                " `flash` and `safe` need the motor's own MacTalk line: the gateway does not carry them.";
    }
}

}  // namespace nplc::macreg
