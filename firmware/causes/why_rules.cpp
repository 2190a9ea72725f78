#include "why_facts.h"

namespace nplc::causes {
namespace {

using F = const Facts&;
using enum Severity;
using RunState = registers::gateway::RunState;

constexpr std::string_view kOtherModes = "`macreg set MODE_REG INIT_MODE`, then the mode that is wanted.";
constexpr std::string_view kMakers = "The right value is the maker's, the manuals name none. {restore}";
constexpr std::string_view kRaiseVoltage =
    "Raise the voltage at the analogue input (up to 10 V either way); check its wiring and ANINP_OFFSET.";
constexpr std::string_view kArrived =
    "The motor is where it should be: its profile has reached the target ({P_SOLL}, {P_IST}).";
constexpr std::string_view kArrivedBy = "P_SOLL P_FNC P_IST ANINP";
constexpr std::string_view kSwapped =
    "MIN_P_IST is not below MAX_P_IST: every position is outside, and the motor makes itself passive "
    "(PLIM_ERR).";
constexpr std::string_view kLimits = "P_SOLL P_IST MIN_P_IST MAX_P_IST";

bool stands_at_target(F f) {
    return f.has_arrived() && !f.is_apart() && !f.lags();
}
bool is_at_voltage(F f) {
    return stands_at_target(f) && f.mode() == kAnaloguePosition;
}
bool is_at_level(F f) {
    return stands_at_target(f) && f.mode() == kAnalogue2Position;
}
bool has_wide_dead_band(F f) {
    return std::abs(f.at("P2")) * f.full_voltage() / 16 <= f.at("P3");
}
bool follows_pulses(F f) {
    return f.gears() || f.mode() == kAnalogueVelocityGear;
}
bool follows_voltage(F f) {
    return f.mode() == kAnalogueTorque || f.mode() == kAnalogueVelocity;
}
bool coil_is_inside(F f) {
    return f.allows(f.at("P1")) && f.allows(f.at("P4"));
}
bool shuts_down_by_supply(F f) {
    return (f.at("UV_HANDLE") & (f.large() ? 4 : 8)) != 0;
}
bool waits_for_gateway(F f) {
    return f.mode() == kInit && f.gateway() && !f.has_any_error();
}

constexpr Rule<Facts> pointer(std::string_view name, Rule<Facts>::Condition is_set) {
    return {
        "pointer_stuck",
        hinders,
        is_set,
        "{=*} is {#*}, and there is no register of that number: nothing was selected.",
        name,
        "`macreg set {=*} 0` ends it, and nothing is selected; 8 is the most for P and V, 4 for the others."};
}

constexpr Rule<Facts> kRules[] = {
    // it moves
    {"runaway", stops, [](F f) { return f.runs_away(); },
     "CUT ITS POWER: the motor turns much faster than {MODE_REG} asks for ({V_IST}, {SPEED}), and does not "
     "slow down.",
     "MODE_REG V_IST SPEED P_IST FLWERR VF_OUT",
     "A stop by the line may not stop it. Then find out what drives it: a load, or filters, signs and rotor "
     "angle that make the regulator drive the wrong way (parameters of another motor)."},
    {"moves", tells, [](F f) { return f.moves() && f.is_passive(); },
     "The shaft turns although the motor is passive ({V_IST}): something else turns it.", "V_IST P_IST",
     "Look what drives the shaft: a hanging load, a belt, or the way of a motor that was switched off."},
    {"moves", tells, [](F f) { return f.moves() && !f.is_passive() && !f.runs_away(); },
     "It moves: {V_IST}.", "V_IST P_IST",
     "If that is as wanted, there is nothing to mend; if the machine stands, look at the coupling."},

    // no power, no line
    {"gateway_link_down", stops,
     [](F f) { return f.gateway() && !f.gateway_has(registers::gateway::kLinkDelivers); },
     "The gateway's FastMAC link to the motor does not work, so no order of the sequence arrives.", "",
     "`nanoctl status` and `nanoctl log` tell more; mend the line, or run `macreg prepare` on the motor's own "
     "port."},
    {"undervoltage", stops, [](F f) { return f.undervoltage_stops(); },
     "The motor's supply is too low: {SUPPLY}, below what is allowed{least supply}.",
     "ERR_STAT SUPPLY U_MIN_SUP", "{mend supply}"},

    // what would bring an error back, or makes torque impossible
    {"limits_swapped", stops, [](F f) { return f.at("MIN_P_IST") > f.at("MAX_P_IST"); }, kSwapped, kLimits,
     "`macreg set MIN_P_IST {#MAX_P_IST} MAX_P_IST {#MIN_P_IST}`, the lower one smaller; both 0 is none.",
     Lets::nothing, [](F f) { return !f.limited(); }},
    {"limits_swapped", stops,
     [](F f) { return f.has_limits() && f.at("MIN_P_IST") == f.at("MAX_P_IST"); }, kSwapped, kLimits,
     "`macreg set MIN_P_IST 0 MAX_P_IST 0`, or two places, the lower one smaller; both 0 is none.",
     Lets::nothing, [](F f) { return !f.limited(); }},
    {"heat_limit_zero", stops, [](F f) { return f.at("I2TLIM") == 0; },
     "I2TLIM, the limit of the windings' heat, is 0: any current is too much, and the motor makes itself "
     "passive (I2T_ERR).",
     "I2TLIM I2T", kMakers},
    {"brake_limit_zero", stops, [](F f) { return f.at("UITLIM") == 0; },
     "UITLIM, the limit of the brake chopper's heat, is 0: the motor makes itself passive as soon as it "
     "brakes (UIT_ERR).",
     "UITLIM UIT", kMakers},
    {"follow_limit_small", stops, [](F f) { return f.follow_limit_is_small() && !f.moves(); },
     "FLWERRMAX ({#FLWERRMAX}) is less than the way of 3 samples at full velocity: a motor that is well may "
     "pass it, and makes itself passive (FLW_ERR).",
     "FLWERRMAX FLWERR SPEED", "`macreg set {wider follow limit}`, or less velocity; 0 is no limit.",
     Lets::nothing, [](F f) { return !f.has_error("FLW_ERR"); }},
    {"load_factor_zero", stops, [](F f) { return f.at("KVOUT") == 0; },
     "KVOUT, the load factor, is 0: the torque that the regulator asks for is multiplied by it.", "KVOUT",
     "{set load factor}"},
    {"amplitude_zero", stops, [](F f) { return f.all_zero("AMPLITUDE"); },
     "AMPLITUDE is 0, so no current flows in the windings.", "AMPLITUDE", "{restore}"},
    {"regulator_zero", stops, [](F f) { return f.all_zero("KVFX1 KVFX2 KVFX3 KVFX4 KVFX5 KVFX6"); },
     "All numerators of the speed regulator (KVFX) are 0: it never asks for torque.", "KVFX1", "{restore}"},
    {"profile_filter_zero", stops, [](F f) { return f.all_zero("KFF0 KFF1 KFF2 KFF3 KFF4 KFF5"); },
     "All coefficients of the profile's filter (KFF) are 0: no velocity gets through it.", "KFF0",
     "{restore}"},
    {"current_regulator_zero", stops, [](F f) { return f.all_zero("KIFX1 KIFX2"); },
     "The current regulator's numerators (KIFX) are 0: no voltage reaches the windings.", "KIFX1",
     "{restore}"},
    {"error_old_filt_err", stops, [](F f) { return f.has_error("OLD_FILT_ERR"); },
     "OLD_FILT_ERR: The filters' parameters are not valid.", "ERR_STAT", "{restore} Then {clear}."},
    {"error_index_err", stops, [](F f) { return f.has_error("INDEX_ERR"); },
     "INDEX_ERR: The encoder has a fault.", "ERR_STAT",
     "Switch the motor off and on; if it stays, the motor needs repair. Then {clear}."},
    {"error_u24v_err", stops, [](F f) { return f.has_error("U24V_ERR"); },
     "U24V_ERR: The control supply was too low.", "ERR_STAT U_24V", "Mend the 24 V supply. Then {clear}."},
    {"torque_zero", stops,
     [](F f) { return f.has_demands() && f.mode() != kHome1 && f.at("T_SOLL") == 0; },
     "T_SOLL, the torque that the motor may use, is 0.", "T_SOLL",
     "`macreg set T_SOLL 100%`, or less if the machine takes less.", Lets::turn},

    // errors that are held
    {"error_plim_err", stops, [](F f) { return f.has_error("PLIM_ERR"); },
     "PLIM_ERR: The shaft left its position limits (MIN_P_IST, MAX_P_IST) and the motor made itself passive.",
     "ERR_STAT P_IST MIN_P_IST MAX_P_IST", "{way back}", Lets::turn},
    {"error_i2t_err", stops, [](F f) { return f.has_error("I2T_ERR"); },
     "I2T_ERR: The windings were too hot, as computed (I2T above I2TLIM), and the motor made itself passive.",
     "ERR_STAT I2T I2TLIM",
     "Free the shaft if something holds it; let it cool down; use less torque or acceleration, less load, "
     "more pauses. Then {clear}."},
    {"error_uit_err", stops, [](F f) { return f.has_error("UIT_ERR"); },
     "UIT_ERR: Braking gave back more energy than the motor can burn (UIT above UITLIM), and it made itself "
     "passive.",
     "ERR_STAT UIT UITLIM A_SOLL",
     "Brake more gently (A_SOLL), or mount an external power dump. Then {clear}."},
    {"error_flw_err", stops, [](F f) { return f.has_error("FLW_ERR"); },
     "FLW_ERR: The motor could not follow (FLWERR passed FLWERRMAX) and made itself passive.",
     "ERR_STAT FLWERR FLWERRMAX T_SOLL A_SOLL",
     "Free the shaft, allow more torque (T_SOLL), ask for less acceleration (A_SOLL), or widen FLWERRMAX. "
     "Then {clear}."},
    {"error_fnc_err", stops, [](F f) { return f.has_error("FNC_ERR"); },
     "FNC_ERR: The torque was too small for the profile (FNCERR passed FNCERRMAX) and the motor made itself "
     "passive.",
     "ERR_STAT FNCERR FNCERRMAX T_SOLL A_SOLL",
     "Free the shaft, allow more torque (T_SOLL), ask for less acceleration (A_SOLL), or widen FNCERRMAX. "
     "Then {clear}."},
    {"error_uv_err", stops, [](F f) { return f.has_error("UV_ERR"); },
     "UV_ERR: The supply voltage was too low.", "ERR_STAT U_SUPPLY U_BUS U_MIN_SUP UV_HANDLE",
     "Mend the supply: voltage, fuse, cross-section, inrush. Then {clear}."},
    {"error_degc_err", stops, [](F f) { return f.has_error("DEGC_ERR"); },
     "DEGC_ERR: The motor is too hot (DEGC above DEGCMAX) and made itself passive.", "ERR_STAT DEGC DEGCMAX",
     "Let it cool down; use less torque, or cool it. Then {clear}."},
    {"error_ov_err", stops, [](F f) { return f.has_error("OV_ERR"); },
     "OV_ERR: The bus voltage was too high, mostly by braking.", "ERR_STAT U_BUS A_SOLL",
     "Brake more gently (A_SOLL), or mount an external power dump. Then {clear}."},
    {"error_ipeak_err", stops, [](F f) { return f.has_error("IPEAK_ERR"); },
     "IPEAK_ERR: The current in the windings was too high.", "ERR_STAT",
     "Look for a short circuit; bring the filters' parameters back. Then {clear}."},
    {"error_speed_err", stops, [](F f) { return f.has_error("SPEED_ERR"); },
     "SPEED_ERR: The motor was faster than it may be.", "ERR_STAT V_SOLL V_IST",
     "Ask for less velocity; look for a load that drives the shaft. Then {clear}."},

    // who commands the motor
    {"gateway_safe", stops, [](F f) { return f.gateway_has(registers::gateway::kSafe); },
     "The gateway is in its safe state: {safe reason}.", "",
     "{safe remedy}", Lets::nothing, [](F f) { return f.moves(); }},
    {"gateway_held", stops,
     [](F f) { return f.gateway_is(RunState::held) || f.gateway_is(RunState::holding); },
     "The gateway's sequence is held, the motor stopped.", "",
     "`nanoctl run` lets it go on, `nanoctl step` goes a step."},
    {"gateway_stopped", stops, [](F f) { return f.gateway_is(RunState::stopped); },
     "The gateway's sequence is stopped, so it gives the motor no orders.", "", "`nanoctl run` starts it.",
     Lets::nothing, [](F f) { return f.moves(); }},
    {"mode_unknown", stops, [](F f) { return f.mode() > kGearFollow || f.mode() < 0; },
     "MODE_REG is {#MODE_REG}, which is no mode.", "MODE_REG", kOtherModes},
    {"test_mode", stops,
     [](F f) { return is_test(f.mode()); },
     "{MODE_REG}: a mode of the maker's tests, which follows no velocity and no position.", "MODE_REG",
     kOtherModes},

    // parameters of the command
    {"acceleration_zero", stops, [](F f) { return f.has_demands() && f.at("A_SOLL") == 0; },
     "A_SOLL, the acceleration, is 0: the velocity can never change.", "A_SOLL",
     "`macreg set A_SOLL 10000rpm/s`, for example.", Lets::turn},
    {"velocity_zero", stops,
     [](F f) {
         return f.demands_velocity() && f.at("V_SOLL") == 0 && f.gateway_is(RunState::running) &&
                !shuts_down_by_supply(f);
     },
     "V_SOLL, the velocity or its limit, is 0: the gateway's sequence has stopped the motor and gives it the "
     "next order itself.",
     "V_SOLL",
     "Give its step what it waits for, such as an acknowledgement: `nanoctl status` names the step and what is "
     "on, `seqc report` what ends it."},
    {"velocity_zero", stops,
     [](F f) { return f.demands_velocity() && f.at("V_SOLL") == 0 && !shuts_down_by_supply(f); },
     "V_SOLL, the velocity or its limit, is 0.", "V_SOLL UV_HANDLE",
     "`macreg set V_SOLL 500rpm`, for example.", Lets::turn},
    {"velocity_zero", stops,
     [](F f) { return f.demands_velocity() && f.at("V_SOLL") == 0 && shuts_down_by_supply(f); },
     "V_SOLL, the velocity or its limit, is 0.", "V_SOLL UV_HANDLE",
     "`macreg set V_SOLL 500rpm`, for example. UV_HANDLE lets undervoltage set it to 0: look at the supply.",
     Lets::turn},
    {"home_velocity_zero", stops, [](F f) { return f.homes() && f.at("V_HOME") == 0; },
     "The motor homes, but V_HOME, the velocity of it, is 0.", "V_HOME",
     "`macreg set V_HOME -200rpm`, for example; its sign is the direction.", Lets::turn},
    {"home_torque_zero", stops, [](F f) { return f.mode() == kHome1 && f.at("T_HOME") == 0; },
     "The motor homes against a stop, but T_HOME, the torque for it, is 0.", "T_HOME",
     "`macreg set T_HOME 30%`, for example.", Lets::turn},
    {"gear_zero", stops, [](F f) { return follows_pulses(f) && f.at("GEARF1") == 0; },
     "GEARF1 is 0: the motor follows the pulses with 0 times their speed.", "GEARF1 GEARF2",
     "`macreg set GEARF1 1`; GEARF1 / GEARF2 is the ratio.", Lets::turn},
    {"gear_denominator_zero", stops, [](F f) { return follows_pulses(f) && f.at("GEARF2") == 0; },
     "GEARF2 is 0: the gear ratio GEARF1 / GEARF2 is none.", "GEARF1 GEARF2", "`macreg set GEARF2 1`.",
     Lets::turn},
    {"pulse_pins_taken", stops,
     [](F f) { return follows_pulses(f) && f.has_no_pulses() && f.pulse_pins_are_taken(); },
     "The motor is to follow pulses, but the pins of the pulse input serve something else (USERINTF is not "
     "00, or was not at the last reset).",
     "CNTRL_BITS V_EXT",
     "`{free pins}`, then {flash save}: it counts from a reset on. The pins are FastMAC's then no more: a PLC "
     "or a gateway that is wired to them loses the motor."},
    {"coil_setup", stops, [](F f) { return f.mode() == kCoil && !f.coil_is_set_up(); },
     "The coil's setup is none: P1 <= P2 <= P3 <= P4 with P1 below P4 must hold (001 4.4.20).",
     "P1 P2 P3 P4",
     "Set P1 to P4: thread left, stop left, stop right, thread right; inside the position limits, if there "
     "are any.",
     Lets::turn},
    {"coil_outside_limits", stops,
     [](F f) { return f.mode() == kCoil && f.coil_is_set_up() && !coil_is_inside(f); },
     "The coil's way is not inside the position limits: the motor makes itself passive on it (PLIM_ERR).",
     "P1 P4 MIN_P_IST MAX_P_IST", "Set P1 to P4 inside, or widen the limits.", Lets::turn},
    {"voltage_outside_limits", stops, [](F f) { return f.voltage_leads_out(); },
     "The voltage at the analogue input can send the motor out of its position limits, where it makes itself "
     "passive (PLIM_ERR).",
     "P1 P2 MIN_P_IST MAX_P_IST",
     "Choose P1 and P2 so that all they reach is inside, or widen the limits.", Lets::turn},
    {"no_pulses", stops,
     [](F f) { return follows_pulses(f) && f.has_no_pulses() && !f.pulse_pins_are_taken() && f.large(); },
     "The motor is to follow pulses, and none come (V_EXT is 0).", "V_EXT CNTRL_BITS",
     "Turn the master; check the wiring.", Lets::turn},
    {"no_pulses", stops,
     [](F f) { return follows_pulses(f) && f.has_no_pulses() && !f.pulse_pins_are_taken() && !f.large(); },
     "The motor is to follow pulses, and none come (V_EXT is 0).", "V_EXT CNTRL_BITS",
     "Turn the master; check the wiring and the format (PULSEDIR: pulse and direction, else quadrature). If "
     "USERINTF was set after the last reset, the pins are not those of the pulse input yet: {flash save} keeps "
     "it and resets.",
     Lets::turn},
    {"analogue_zero", stops,
     [](F f) { return follows_voltage(f) && f.voltage() <= f.full_voltage() / 100; },  // 0.1 V
     "{MODE_REG} follows the voltage at the analogue input, and there is hardly any: {ANINP}.",
     "ANINP MODE_REG", kRaiseVoltage, Lets::turn},
    {"analogue_dead_band", stops,
     [](F f) { return f.mode() == kAnalogueVelocityZero && f.voltage() <= (f.large() ? 128 : 64); },
     "The voltage at the analogue input is inside the dead band: {ANINP}.", "ANINP", kRaiseVoltage,
     Lets::turn},
    {"analogue_torque_zero", stops,
     [](F f) {
         return f.mode() == kVelocityAnalogueTorque && f.at("T_SOLL") != 0 && f.torque_limit() == 0;
     },
     "The voltage at the analogue input is the torque limit, and there is hardly any: {ANINP}.",
     "ANINP T_SOLL", kRaiseVoltage, Lets::turn},

    // the command
    {"safe_mode", stops, [](F f) { return f.mode() == kSafe; },
     "The motor is in SAFE_MODE: passive, and no mode can be chosen.", "MODE_REG",
     "`macreg safe exit`, then choose a mode."},
    {"passive", stops, [](F f) { return f.mode() == kInit && f.has_any_error(); },
     "The motor is in INIT_MODE, passive, because of the error.", "MODE_REG STARTMODE",
     "When the error is cleared: {start}", Lets::turn},
    {"passive", stops, waits_for_gateway,
     "The motor is in INIT_MODE, passive: the gateway's sequence has not told it to move.",
     "MODE_REG STARTMODE",
     "`nanoctl status` and `nanoctl watch` show in which step the sequence is, and whether it runs.",
     Lets::turn},
    {"passive", stops, [](F f) { return f.mode() == kInit && !f.gateway() && !f.has_any_error(); },
     "The motor is in INIT_MODE: passive, no motion was ordered.", "MODE_REG STARTMODE",
     "{start} {=STARTMODE} is the mode after power-up.", Lets::turn},
    {"profile_apart", stops, [](F f) { return f.has_arrived() && f.is_apart(); },
     "The motor's profile has reached the target ({P_SOLL}), but by P_IST the shaft is elsewhere ({P_IST}): "
     "{=P_FNC} and P_IST count from different places. P_IST was written alone, or positions were chosen "
     "relatively (RELPOSPFNC).",
     "P_SOLL P_FNC P_IST FLWERR",
     "It will not go there by itself. To go on from here with one count for all: `{resynchronise}`; the shaft "
     "does not turn by it."},

    // the shaft is held
    {"blocked", stops, [](F f) { return f.pushes() && f.torque_limit() >= 1000; },
     "The motor pushes with its full torque ({VF_OUT}) and stands: its shaft is blocked, or the load is too "
     "heavy.",
     "VF_OUT TORQUE FLWERR FNCERR V_IST",
     "Free the shaft; look for a holding brake, a mechanical stop, a wrong direction.", Lets::jump},
    {"torque_too_small", stops, [](F f) { return f.pushes() && f.torque_limit() < 1000; },
     "The motor pushes with all the torque it may use ({TORQUE}) and stands.",
     "VF_OUT TORQUE FLWERR FNCERR V_IST",
     "Free the shaft, or allow more torque: `macreg set T_SOLL 100%` if the machine may take it.",
     Lets::jump},
    {"lags", stops, [](F f) { return f.has_arrived() && !f.is_apart() && f.lags(); },
     "The motor's profile has reached the target ({P_SOLL}), but the shaft stands {FLWERR} from it.",
     "P_SOLL P_IST FLWERR T_SOLL VF_OUT",
     "Something holds the shaft, or T_SOLL is too small for it: free it, or allow more torque.", Lets::jump},
    {"positions_equal", stops, [](F f) { return is_at_level(f) && f.at("P1") == f.at("P2"); }, kArrived,
     kArrivedBy, "P1 and P2 are one place, so no level moves it: {another P2}, for example.", Lets::turn},
    {"range_zero", stops, [](F f) { return is_at_voltage(f) && f.at("P2") == 0; }, kArrived, kArrivedBy,
     "P2 is 0, so no voltage moves it: `macreg set P2 10`, for example (10 V then go 640 counts from P1, 1280 "
     "on a MAC800).",
     Lets::turn},
    {"dead_band_wide", stops,
     [](F f) { return is_at_voltage(f) && f.at("P2") != 0 && has_wide_dead_band(f); }, kArrived, kArrivedBy,
     "P3, the dead band, is as wide as all that P2 lets a voltage do: `macreg set P3 0`, or a larger P2.",
     Lets::turn},
    {"at_target", stops, [](F f) { return stands_at_target(f) && f.mode() == kPosition; }, kArrived,
     kArrivedBy, "Give it another target: {another P_SOLL}, for example, or P_REG_P for one of P1 to P8.",
     Lets::turn},
    {"waits_for_level", stops, [](F f) { return is_at_level(f) && f.at("P1") != f.at("P2"); }, kArrived,
     kArrivedBy, "It goes to the other position (P1, P2) when the level at the analogue input changes.",
     Lets::turn},
    {"waits_for_voltage", stops,
     [](F f) { return is_at_voltage(f) && f.at("P2") != 0 && !has_wide_dead_band(f); }, kArrived, kArrivedBy,
     "The voltage at the analogue input chooses the target; 10 V go 64 times P2 from P1 (128 times on a "
     "MAC800), P3 is the dead band.",
     Lets::turn},
    {"coil_waits", hinders,
     [](F f) {
         return f.mode() == kCoil && f.coil_is_set_up() && coil_is_inside(f) && !f.moves() &&
                f.at("FNC_OUT") == 0;
     },
     "The coil waits: a high level at the analogue input sends it to its start (P5), and after it low lets it "
     "wind.",
     "ANINP P5", "Give a start position command once after power-up and homing; then turn the spool.",
     Lets::turn},
    {"homing_switch", hinders, [](F f) { return f.homes() && f.mode() != kHome1; },
     "The motor homes and waits for its switch at the analogue input, which counts as on when {switch on} "
     "(sign of T_HOME); it is {switch now} now: {ANINP}.",
     "MODE_REG ANINP T_HOME V_HOME",
     "If it never comes: check switch, wiring and the signs of T_HOME and V_HOME. INIT_MODE ends the search."},
    {"homing_stop", hinders, [](F f) { return f.mode() == kHome1; },
     "The motor homes until it meets a mechanical stop with {T_HOME}; {VF_OUT} now.",
     "MODE_REG T_HOME V_HOME VF_OUT",
     "If it stands before its stop, T_HOME is too small for the friction; INIT_MODE ends the search."},

    // stops nothing yet
    {"undervoltage_recent", hinders, [](F f) { return f.undervoltage_is_over(); },
     "The supply was too low a moment ago; it is {SUPPLY} now.", "ERR_STAT SUPPLY U_MIN_SUP",
     "Ask again in a second; if it comes back, the supply sags under load."},
    {"i2t_near", hinders, [](F f) { return f.is_near("I2T", "I2TLIM"); },
     "The windings are nearly too hot, as computed: the motor will soon make itself passive (I2T_ERR).",
     "I2T I2TLIM", "Less torque, less acceleration or more pauses."},
    {"uit_near", hinders, [](F f) { return f.is_near("UIT", "UITLIM"); },
     "The brake chopper is nearly too hot: the motor will soon make itself passive (UIT_ERR).", "UIT UITLIM",
     "Brake more gently (A_SOLL), or mount an external power dump."},
    {"hot_near", hinders, [](F f) { return f.large() && f.is_near("DEGC", "DEGCMAX"); },
     "The motor is nearly too hot: {DEGC}.", "DEGC DEGCMAX", "Less torque, or cooling."},
    {"current_range", hinders, [](F f) { return f.has_error("IX_ERR"); },
     "IX_ERR: a phase current was at the end of its measuring range; the current regulator is upset or the "
     "supply too high.",
     "ERR_STAT AMPLITUDE",
     "Bring the filters' parameters back; less A_SOLL. Clear it: `{clear command}`."},
    {"frame_errors", hinders, [](F f) { return f.has_error("FRAME_ERR_TX"); },
     "The motor sees framing errors on its FastMAC line: commands get lost.", "ERR_STAT",
     "Check wiring, termination and speed of the FastMAC line (19200 baud, RS422)."},
    {"stop_mode", hinders, [](F f) { return f.mode() == kStop; },
     "The motor brakes in STOP_MODE on its way to another mode ({V_IST}).", "MODE_REG V_IST A_SOLL",
     "It ends below 300 rpm. If it stays, something drives the shaft, or A_SOLL is too small."},
    {"velocity_tiny", hinders,
     [](F f) {
         const std::int64_t v = std::abs(f.at("V_SOLL"));
         return f.demands_velocity() && v != 0 && v < f.tiny_velocity();
     },
     "{V_SOLL} is so slow that it looks like standing.", "V_SOLL",
     "`macreg set V_SOLL 500rpm`; without unit a number is raw steps, not rpm.", Lets::turn},
    {"target_outside_limits", hinders,
     [](F f) {
         return f.limited() && !f.limits_leave_none() && f.positions() && !f.ends_inside();
     },
     "The target ({P_SOLL}) is not inside the position limits: on its way the motor makes itself passive "
     "(PLIM_ERR).",
     kLimits, "{another P_SOLL}, for example, or wider limits; both 0 is none."},
    pointer("P_REG_P", [](F f) { return f.at("P_REG_P") != 0; }),
    pointer("V_REG_P", [](F f) { return f.at("V_REG_P") != 0; }),
    pointer("A_REG_P", [](F f) { return f.at("A_REG_P") != 0; }),
    pointer("T_REG_P", [](F f) { return f.at("T_REG_P") != 0; }),
    pointer("L_REG_P", [](F f) { return f.at("L_REG_P") != 0; }),
    pointer("Z_REG_P", [](F f) { return f.at("Z_REG_P") != 0; }),

    // information
    {"gateway_runs", tells,
     [](F f) {
         return f.gateway() && !f.gateway_is(RunState::stopped) && !f.gateway_is(RunState::held) &&
                !f.gateway_is(RunState::holding);
     },
     "The gateway's sequence runs and orders the motor's modes and targets: what is set here it may set "
     "again.",
     "", "`nanoctl watch` shows which step it waits in; `nanoctl stop` before setting anything here."},
    {"limits_off", tells, [](F f) { return f.has_limits() && !f.limits_leave_none() && !f.limited(); },
     "DIS_P_LIM is set in ERR_STAT: MIN_P_IST and MAX_P_IST do not act.", kLimits,
     "If they are to act, and P_IST is inside, take DIS_P_LIM out of ERR_STAT (`macreg get ERR_STAT` shows "
     "what else is set)."},
    {"user_interface_waits", tells, [](F f) { return f.user_interface_waits(); },
     "CNTRL_BITS asks for another user interface than the one that acts: it counts from a reset on, and the "
     "pins are still those of {pin owner}.",
     "CNTRL_BITS V_EXT", "If it is to act: {flash save} keeps it and resets the motor."},
    {"fastmac_owns", tells,
     [](F f) {
         return !f.large() && (f.at("CNTRL_BITS") & kUserInterface) == kUserInterface && !f.gateway() &&
                !f.user_interface_waits();
     },
     "The user interface is set to FastMAC, which acts if it was so at the last reset: whoever is wired to it "
     "(an expansion module, a PLC) may set modes and targets at any time.",
     "CNTRL_BITS",
     "If values change by themselves, stop that one first; {safe enter} makes the motor passive, and it then "
     "ignores FastMAC."},
};

}  // namespace

std::span<const Rule<Facts>> rules() {
    return kRules;
}

}  // namespace nplc::causes
