// Which cause is told first, and what stands before a remedy.
#include <algorithm>
#include <array>
#include <span>

#include "registers/gateway.h"
#include "why_parts.h"

namespace nplc::macreg {

namespace gw = registers::gateway;

namespace {

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

void sort_by_rank(Findings& findings) {
    std::stable_sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
        const bool moves_a = among(kMoves, a.code), moves_b = among(kMoves, b.code);
        if (moves_a != moves_b) return moves_a;
        if (a.severity != b.severity) return a.severity < b.severity;
        return rank_of(a) < rank_of(b);
    });
}

void begin_safely(const Facts& facts, Findings& findings) {
    if (facts.moves()) return;
    for (Finding& one : findings) {
        if (among(kLetTurn, one.code)) one.remedy.insert(0, before_it_turns(facts));
        if (among(kFree, one.code))
            one.remedy.insert(
                0,
                "First `macreg set MODE_REG INIT_MODE`: it pushes, and would jump as soon as it can "
                "turn (hold a hanging load, which falls by that). Then: ");
    }
}

void pass_gateway(const Facts& facts, Findings& findings) {
    if (!facts.gateway()) return;
    const bool stopped =
        static_cast<gw::RunState>(facts.gateway()->status & gw::kRunState) == gw::RunState::stopped;
    for (Finding& one : findings) {
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
