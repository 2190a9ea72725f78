#include "causes/codes.h"

#include <algorithm>

namespace nplc::causes {
namespace {

// clang-format off
constexpr Code kCodes[] = {
    {1, "moves", "it moves"},
    {2, "unknown", "nothing is found that keeps it from moving"},
    {3, "runaway", "it turns much faster than told: cut its power"},
    {10, "gateway_link_down", "the link to the motor does not work"},
    {11, "gateway_safe", "the gateway is in its safe state; safe_reason says why"},
    {12, "gateway_held", "the sequence is held"},
    {13, "gateway_stopped", "the sequence is stopped"},
    {14, "gateway_runs", "the sequence runs, and orders what the motor does"},
    {20, "undervoltage", "the supply is too low"},
    {21, "undervoltage_recent", "the supply was too low a moment ago"},
    {30, "limits_swapped", "MIN_P_IST is not below MAX_P_IST"},
    {31, "heat_limit_zero", "I2TLIM is 0"},
    {32, "brake_limit_zero", "UITLIM is 0"},
    {33, "follow_limit_small", "FLWERRMAX is too small for the velocity"},
    {34, "load_factor_zero", "KVOUT is 0"},
    {35, "amplitude_zero", "AMPLITUDE is 0"},
    {36, "regulator_zero", "the speed regulator's numerators are 0"},
    {37, "profile_filter_zero", "the profile filter's coefficients are 0"},
    {38, "current_regulator_zero", "the current regulator's numerators are 0"},
    {39, "torque_zero", "T_SOLL is 0"},
    {40, "acceleration_zero", "A_SOLL is 0"},
    {41, "velocity_zero", "V_SOLL is 0"},
    {42, "velocity_tiny", "V_SOLL is so small that it looks like standing"},
    {43, "home_velocity_zero", "V_HOME is 0"},
    {44, "home_torque_zero", "T_HOME is 0"},
    {45, "gear_zero", "the gear's numerator is 0"},
    {46, "gear_denominator_zero", "the gear's denominator is 0"},
    {50, "error_old_filt_err", "OLD_FILT_ERR: the filters' parameters are not valid"},
    {51, "error_index_err", "INDEX_ERR: the encoder has a fault"},
    {52, "error_u24v_err", "U24V_ERR: the control supply was too low"},
    {53, "error_plim_err", "PLIM_ERR: the shaft left its position limits"},
    {54, "error_i2t_err", "I2T_ERR: the windings were too hot"},
    {55, "error_uit_err", "UIT_ERR: the brake chopper was too hot"},
    {56, "error_flw_err", "FLW_ERR: the shaft was too far from its profile"},
    {57, "error_fnc_err", "FNC_ERR: the shaft fell behind for too long"},
    {58, "error_uv_err", "UV_ERR: the supply was too low"},
    {59, "error_degc_err", "DEGC_ERR: the motor was too hot"},
    {60, "error_ov_err", "OV_ERR: the supply was too high"},
    {61, "error_ipeak_err", "IPEAK_ERR: a phase current was too high"},
    {62, "error_speed_err", "SPEED_ERR: it turned too fast"},
    {70, "passive", "INIT_MODE: no motion was ordered, or an error made it passive"},
    {71, "safe_mode", "SAFE_MODE: passive, and no mode can be chosen"},
    {72, "mode_unknown", "MODE_REG holds no mode"},
    {73, "test_mode", "a mode of the maker's tests"},
    {74, "stop_mode", "it brakes in STOP_MODE"},
    {80, "pulse_pins_taken", "the pulse input's pins are FastMAC's"},
    {81, "no_pulses", "it is to follow pulses, and none come"},
    {82, "coil_setup", "the coil mode's parameters are not whole"},
    {83, "coil_outside_limits", "the coil's positions are not inside the position limits"},
    {84, "coil_waits", "the coil waits for its start"},
    {85, "voltage_outside_limits", "the analogue input can lead it out of its position limits"},
    {86, "analogue_zero", "the analogue input has no voltage"},
    {87, "analogue_dead_band", "the analogue input is inside its dead band"},
    {88, "analogue_torque_zero", "the analogue input, which limits the torque, has no voltage"},
    {100, "profile_apart", "profile and shaft count from different places"},
    {101, "blocked", "it pushes with full torque and stands"},
    {102, "torque_too_small", "it pushes with all the torque it may use and stands"},
    {103, "lags", "the profile has arrived, the shaft has not"},
    {104, "at_target", "it is at its target"},
    {105, "positions_equal", "P1 and P2 are one place"},
    {106, "range_zero", "P2 is 0, so no voltage moves it"},
    {107, "dead_band_wide", "P3, the dead band, swallows all voltages"},
    {108, "waits_for_level", "it is at its target, and waits for the input's level"},
    {109, "waits_for_voltage", "it is at its target, and waits for another voltage"},
    {110, "homing_switch", "it homes, and waits for its switch"},
    {111, "homing_stop", "it homes, and has not met its stop"},
    {112, "target_outside_limits", "the target is not inside the position limits"},
    {120, "i2t_near", "the windings are nearly too hot"},
    {121, "uit_near", "the brake chopper is nearly too hot"},
    {122, "hot_near", "the motor is nearly too hot"},
    {123, "current_range", "IX_ERR: a phase current was at the end of its range"},
    {124, "frame_errors", "the motor sees framing errors on its FastMAC line"},
    {125, "pointer_stuck", "a pointer register names a register that is not there"},
    {140, "limits_off", "the position limits are switched off"},
    {141, "user_interface_waits", "CNTRL_BITS asks for another user interface than the one that acts"},
    {142, "fastmac_owns", "FastMAC may set modes and targets at any time"},
    {160, "amplifier_trip", "MIDI: the amplifier switched itself off"},
    {161, "motor_hot", "MIDI: the motor was too hot"},
    {162, "too_hot", "MIDI: the module was too hot, or its amplifier or encoder failed"},
    {163, "no_encoder", "MIDI: the encoder does not answer"},
    {164, "supply_interrupted", "MIDI: the supply fell below 19 V"},
    {165, "under_voltage", "MIDI: the supply is too low"},
    {166, "over_voltage", "MIDI: the supply is too high"},
    {167, "over_voltage_kept", "MIDI: the supply has been too high once"},
    {168, "at_upper_input", "MIDI: the upper end-stop input is on"},
    {169, "at_lower_input", "MIDI: the lower end-stop input is on"},
    {170, "stops_crossed", "MIDI: the lower software stop lies above the upper one"},
    {171, "above_upper_stop", "MIDI: it is beyond the upper software stop"},
    {172, "below_lower_stop", "MIDI: it is beyond the lower software stop"},
    {173, "stopped_by_end_stop", "MIDI: an end-stop ended its last motion"},
    {174, "torque_small", "MIDI: the torque is limited to less than 20 %"},
    {175, "does_not_follow", "MIDI: it was ordered to move and does not"},
    {176, "slow", "MIDI: moves are slow"},
    {177, "warm", "MIDI: it is hot"},
    {178, "waits", "MIDI: nothing keeps it from moving; it waits for an order"},
    {179, "same_address", "MIDI: more than one drive answers to the address"},
    {180, "drive_unreadable", "MIDI: its answers come damaged"},
    {181, "drive_restarted", "MIDI: it started anew by itself"},
    {182, "drive_link_lost", "MIDI: the line did not work for a moment"},
    {183, "drive_end_stop", "MIDI: an end-stop ended its motion, and the error is kept"},
    {184, "drive_not_arrived", "MIDI: it stands, and not where it was sent"},
    {185, "drive_refused", "MIDI: it refused a command"},
    {186, "drive_unclear", "MIDI: it is unknown whether it took a command"},
    {187, "drive_bad_value", "MIDI: an order that it cannot do"},
    {188, "drive_jumped", "MIDI: its position jumped in mid-motion"},
};
// clang-format on

}  // namespace

std::span<const Code> codes() {
    return kCodes;
}

std::uint16_t number_of(std::string_view name) {
    const auto* found = std::find_if(std::begin(kCodes), std::end(kCodes),
                                     [name](const Code& code) { return code.name == name; });
    return found == std::end(kCodes) ? 0 : found->number;
}

const Code* find_code(std::uint16_t number) {
    const auto* found = std::find_if(std::begin(kCodes), std::end(kCodes),
                                     [number](const Code& code) { return code.number == number; });
    return found == std::end(kCodes) ? nullptr : found;
}

}  // namespace nplc::causes
