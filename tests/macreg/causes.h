#pragma once

#include <functional>
#include <vector>

#include "bench.h"
#include "macreg/why.h"

/// Each cause that `why` can report, and how a virtual motor is brought into it.
namespace nplc::macreg {

using namespace std::chrono_literals;
using registers::Model;

struct Case {
    const char* code;
    std::function<void(Bench&)> condition;
    Severity severity = Severity::stops;
    base::Milliseconds for_time{600};
    Model model = Model::mac140;
};

/// Pins free for pulses: 001 §3.2.36, counts from a reset on.
inline void free_pulse_pins(Bench& bench) {
    bench.put("CNTRL_BITS", 0);
    bench.sim.store_registers();
    bench.sim.power_cycle();
}

inline void mode(Bench& bench, std::int64_t number) {
    bench.put("MODE_REG", number);
}

inline void block_shaft(Bench& bench) {
    bench.sim.plant().load().high_stop = sim::MechanicalStop{.counts = 0};
    bench.sim.plant().load().low_stop = sim::MechanicalStop{.counts = 0};
}

/// Holds ERR_STAT's bit as if its cause were there; the motor is passive.
inline Case error(const char* code, unsigned bit, Model model = Model::mac140) {
    return {code, [bit](Bench& bench) { bench.put("ERR_STAT", 1 << bit); }, Severity::stops, 300ms, model};
}

inline const std::vector<Case>& cases() {
    static const std::vector<Case> kCases{
        {"passive", [](Bench&) {}},
        {"safe_mode", [](Bench& b) { b.sim.enter_safe_mode(); }},
        {"mode_unknown", [](Bench&) {}},  // distinguished below: a motor refuses such a mode
        {"test_mode", [](Bench& b) { mode(b, 7); }},
        {"stop_mode",
         [](Bench& b) {  // a heavy load that turns on
             mode(b, 1);
             b.put("V_SOLL", 4000);
             b.sim.plant().load().inertia_256 = 256 * 200;
             b.put("A_SOLL", 2);
             b.run(3000ms);
             b.sim.plant().load().torque = 1023;
             mode(b, 11);
         },
         Severity::hinders, 50ms},
        {"error_i2t_err", [](Bench& b) { b.sim.overload(); }},
        {"error_flw_err",
         [](Bench& b) {
             b.put("FLWERRMAX", 100);
             block_shaft(b);
             mode(b, 1);
         }},
        {"error_fnc_err",
         [](Bench& b) {
             b.put("FNCERRMAX", 100);
             block_shaft(b);
             b.put("P_SOLL", 100'000);
             mode(b, 2);
         }},
        error("error_uit_err", 3),
        {"error_plim_err",
         [](Bench& b) {
             b.put("MAX_P_IST", 1000);
             mode(b, 1);
         }},
        {"error_uv_err",
         [](Bench& b) {
             b.put("U_MIN_SUP", 5000);
             b.put("UV_HANDLE", 1);
         }},
        error("error_degc_err", 8, Model::mac800),
        error("error_ov_err", 11, Model::mac800),
        error("error_ipeak_err", 12, Model::mac800),
        error("error_speed_err", 13, Model::mac800),
        {"error_index_err", [](Bench& b) { b.sim.surroundings().encoder_broken = true; }, Severity::stops,
         300ms, Model::mac800},
        {"error_old_filt_err", [](Bench& b) { b.put("KVFX6", 0); }, Severity::stops, 300ms, Model::mac800},
        {"error_u24v_err", [](Bench& b) { b.sim.surroundings().logic_millivolts = 12'000; }, Severity::stops,
         300ms, Model::mac800},
        {"undervoltage", [](Bench& b) { b.put("U_MIN_SUP", 5000); }},
        {"undervoltage_recent",
         [](Bench& b) {
             b.put("U_MIN_SUP", 5000);
             b.run(50ms);
             b.put("U_MIN_SUP", 10);
         },
         Severity::hinders, 50ms},
        {"i2t_near", [](Bench& b) { b.put("I2T", 9'000); },  // of 10,000
         Severity::hinders, 0ms},
        {"heat_limit_zero", [](Bench& b) { b.put("I2TLIM", 0); }},
        {"brake_limit_zero", [](Bench& b) { b.put("UITLIM", 0); }},
        {"current_range", [](Bench& b) { b.put("ERR_STAT", 1 << 11); }, Severity::hinders},
        {"frame_errors", [](Bench& b) { b.put("ERR_STAT", 1 << 8); }, Severity::hinders, 0ms},
        {"torque_zero",
         [](Bench& b) {
             b.put("T_SOLL", 0);
             mode(b, 1);
         }},
        {"velocity_zero",
         [](Bench& b) {
             b.put("V_SOLL", 0);
             mode(b, 1);
         }},
        {"velocity_tiny",
         [](Bench& b) {
             b.put("V_SOLL", 1);
             mode(b, 1);
         },
         Severity::hinders},
        {"acceleration_zero",
         [](Bench& b) {
             b.put("A_SOLL", 0);
             mode(b, 1);
         }},
        {"load_factor_zero",
         [](Bench& b) {
             b.put("KVOUT", 0);
             mode(b, 1);
         }},
        {"amplitude_zero",
         [](Bench& b) {
             b.put("AMPLITUDE", 0);
             mode(b, 1);
         }},
        {"regulator_zero",
         [](Bench& b) {
             for (const char* name : {"KVFX1", "KVFX2", "KVFX3", "KVFX4"}) b.put(name, 0);
             mode(b, 1);
         }},
        {"profile_filter_zero",
         [](Bench& b) {
             for (const char* name : {"KFF0", "KFF1", "KFF2", "KFF3"}) b.put(name, 0);
             mode(b, 1);
         }},
        {"current_regulator_zero",
         [](Bench& b) {
             for (const char* name : {"KIFX1", "KIFX2"}) b.put(name, 0);
             mode(b, 1);
         }},
        {"blocked",
         [](Bench& b) {
             block_shaft(b);
             mode(b, 1);
         }},
        {"torque_too_small",
         [](Bench& b) {
             b.put("T_SOLL", 100);
             b.sim.plant().load().friction_torque = 400;
             mode(b, 1);
         }},
        {"at_target", [](Bench& b) { mode(b, 2); }},
        {"profile_apart",
         [](Bench& b) {
             mode(b, 2);
             b.run(300ms);
             b.put("P_IST", 5000);
         }},
        {"target_outside_limits",
         [](Bench& b) {
             b.put("MIN_P_IST", -100'000);
             b.put("MAX_P_IST", 100'000);
             b.put("V_SOLL", 0);
             b.put("P_SOLL", 200'000);
             mode(b, 2);
         },
         Severity::hinders},
        {"limits_swapped",
         [](Bench& b) {
             b.put("MIN_P_IST", 100);
             b.put("MAX_P_IST", -100);
         }},
        {"gear_zero",
         [](Bench& b) {
             free_pulse_pins(b);
             b.sim.terminals().set_pulse_rate(10'000);
             b.put("GEARF1", 0);
             mode(b, 3);
         }},
        {"gear_denominator_zero",
         [](Bench& b) {
             free_pulse_pins(b);
             b.sim.terminals().set_pulse_rate(10'000);
             b.put("GEARF2", 0);
             mode(b, 3);
         }},
        {"no_pulses",
         [](Bench& b) {
             free_pulse_pins(b);
             mode(b, 3);
         }},
        {"pulse_pins_taken",
         [](Bench& b) {
             b.sim.terminals().set_pulse_rate(10'000);
             mode(b, 24);
         }},
        {"analogue_zero", [](Bench& b) { mode(b, 5); }},
        {"analogue_zero", [](Bench& b) { mode(b, 4); }},
        {"analogue_dead_band",
         [](Bench& b) {
             b.sim.terminals().set_analogue(500);
             mode(b, 16);
         }},
        {"analogue_torque_zero", [](Bench& b) { mode(b, 17); }},
        {"waits_for_level",
         [](Bench& b) {
             b.put("P2", 5000);
             mode(b, 20);
         }},
        {"waits_for_voltage",
         [](Bench& b) {
             b.put("P2", 50);
             mode(b, 21);
         }},
        {"positions_equal", [](Bench& b) { mode(b, 20); }},
        {"range_zero", [](Bench& b) { mode(b, 21); }},
        {"follow_limit_small", [](Bench& b) { b.put("FLWERRMAX", 100); }, Severity::hinders},
        {"limits_off",
         [](Bench& b) {
             b.put("ERR_STAT", 1 << 14);
             b.put("MAX_P_IST", 1000);
         },
         Severity::tells},
        {"coil_setup",
         [](Bench& b) {
             free_pulse_pins(b);
             b.sim.terminals().set_pulse_rate(10'000);
             mode(b, 19);
         }},
        {"coil_waits",
         [](Bench& b) {
             free_pulse_pins(b);
             b.sim.terminals().set_pulse_rate(10'000);
             for (const auto& [name, raw] : {std::pair{"P1", 1000}, {"P2", 2000}, {"P3", 5000}, {"P4", 6000}})
                 b.put(name, raw);
             mode(b, 19);
         },
         Severity::hinders},
        {"coil_outside_limits",
         [](Bench& b) {
             free_pulse_pins(b);
             for (const auto& [name, raw] : {std::pair{"P1", 1000}, {"P2", 2000}, {"P3", 5000}, {"P4", 6000}})
                 b.put(name, raw);
             b.put("MAX_P_IST", 5500);
             b.put("MIN_P_IST", -5500);
             mode(b, 19);
         }},
        {"dead_band_wide",
         [](Bench& b) {
             b.put("P2", 40);
             b.put("P3", 5000);  // 10 V go 2560 counts
             mode(b, 21);
         }},
        {"voltage_outside_limits",
         [](Bench& b) {
             b.put("MAX_P_IST", 2000);
             b.put("MIN_P_IST", -2000);
             b.put("P2", 1000);  // 10 V go 64,000 counts
             mode(b, 21);
         }},
        {"home_velocity_zero",
         [](Bench& b) {
             b.put("V_HOME", 0);
             mode(b, 12);
         }},
        {"home_torque_zero",
         [](Bench& b) {
             b.put("T_HOME", 0);
             mode(b, 12);
         }},
        {"homing_stop",
         [](Bench& b) {
             b.put("V_HOME", 0);
             mode(b, 12);
         },
         Severity::hinders},
        {"homing_switch",
         [](Bench& b) {
             b.put("V_HOME", 0);
             mode(b, 13);
         },
         Severity::hinders},
        {"runaway",
         [](Bench& b) {
             b.put("V_SOLL", 400);
             b.put("T_SOLL", 10);
             mode(b, 1);
             b.sim.plant().load().torque = 1023;
         }},
        {"pointer_stuck", [](Bench& b) { b.put("A_REG_P", 5); }, Severity::hinders},
        {"fastmac_owns", [](Bench&) {}, Severity::tells},
        {"moves", [](Bench& b) { mode(b, 1); }, Severity::tells},
    };
    return kCases;
}

}  // namespace nplc::macreg
