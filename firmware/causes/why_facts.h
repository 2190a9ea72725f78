#pragma once

#include <cstdlib>
#include <span>
#include <string>
#include <string_view>

#include "causes/why.h"
#include "registers/gateway.h"

/// What the rules of `why` evaluate of a condition, and the words in their texts.
namespace nplc::causes {

/// A condition by name and number. In addition to registers there are names whose register depends on the
/// motor's mode and family: SPEED (V_HOME or V_SOLL), TORQUE (T_HOME or T_SOLL), SUPPLY (U_SUPPLY or U_BUS).
class Facts {
  public:
    explicit Facts(const Condition& condition) : condition_(condition) {}

    bool large() const { return condition_.model == registers::Model::mac800; }
    registers::Model model() const { return condition_.model; }
    /// 0 for a register that the motor does not have.
    std::int64_t at(std::string_view name) const { return condition_.now.at(number(name)); }
    std::int64_t before(std::string_view name) const { return condition_.before.at(number(name)); }
    std::uint8_t number(std::string_view name) const;
    /// The name in the model's map; empty if the motor has no such register.
    std::string_view name_of(std::string_view name) const;
    bool knows(std::string_view name) const { return number(name) != 0; }
    bool all_zero(std::string_view names) const;

    /// "1500 rpm", for a sentence.
    std::string text(std::string_view name) const;
    /// "V_SOLL": name and value; "=V_SOLL": the name that the model has for it; "#V_SOLL": its raw value;
    /// "flash save": the command for a motor in this mode; else one of the words in why_facts.cpp.
    std::string word(std::string_view key) const;

    std::int64_t mode() const { return at("MODE_REG"); }
    bool has_error(std::string_view bit) const;
    bool has_any_error() const;
    bool homes() const { return mode() >= kHome1 && mode() <= kHome3; }
    bool gears() const;
    bool positions() const;
    bool is_passive() const { return causes::is_passive(mode()); }
    bool has_velocity_limit() const;
    /// Both regulators are on.
    bool is_driven() const;
    /// The torque, acceleration and other parameters of a mode are checked: it is in such a mode, or, in
    /// INIT_MODE, one will be chosen. A gateway's sequence sets what it needs.
    bool has_demands() const;
    bool demands_velocity() const;
    bool moves() const;
    /// It turns much faster than its mode demands, and is not slowing down.
    bool runs_away() const;
    /// Its profile has reached the target.
    bool has_arrived() const;
    /// By P_IST, its position differs from its profile.
    bool is_apart() const;
    bool lags() const;
    /// With its full permitted torque, and stands still.
    bool pushes() const;

    /// MIN_P_IST and MAX_P_IST act.
    bool limited() const;
    bool has_limits() const;
    bool limits_leave_none() const { return at("MIN_P_IST") >= at("MAX_P_IST"); }
    /// P_MODE with this target ends inside of them (001 §4.4.3).
    bool allows(std::int64_t p_soll) const;
    bool ends_inside() const { return allows(at("P_SOLL")); }
    /// 001 §4.1.10, §4.1.11: the analogue input can send it out of them.
    bool voltage_leads_out() const;
    bool follow_limit_is_small() const;

    bool is_near(std::string_view value, std::string_view limit) const;
    bool undervoltage_is_over() const;
    bool undervoltage_stops() const;
    bool coil_is_set_up() const;
    /// It is to follow pulses, and none come.
    bool has_no_pulses() const;
    bool pulse_pins_are_taken() const;
    bool counts_pulses() const;
    /// CNTRL_BITS selects another user interface than the active one (001 §3.2.36).
    bool user_interface_waits() const;
    /// A gateway's commands arrive, so FastMAC has the pins, whatever CNTRL_BITS has been set to since the
    /// last reset.
    bool speaks_fastmac() const;

    const std::optional<GatewayState>& gateway() const { return condition_.gateway; }
    bool gateway_has(registers::gateway::StatusBit bit) const;
    bool gateway_is(registers::gateway::RunState state) const;

    /// Of V_SOLL; slower motion looks like standstill.
    std::int64_t tiny_velocity() const { return large() ? 14 : 10; }
    /// 10 V at the analogue input.
    std::int64_t full_voltage() const { return large() ? 2047 : 1023; }
    std::int64_t voltage() const { return std::abs(at("ANINP")); }
    /// That the mode allows, 1023 is full; AT_MODE and passive modes have none.
    std::int64_t torque_limit() const;
    /// The velocity of a move: V_SOLL, or the one that `why` recommends if it is almost zero.
    std::int64_t velocity_of_moves() const;
    /// P_IST minus the value that corresponds to P_SOLL: both have the same origin, unless P_IST was written
    /// alone.
    std::int64_t apart() const;
    /// P_SOLL for another position that the limits allow: one turn forward, one turn back, or as far as there
    /// is room.
    std::int64_t other_target() const;
    /// P_SOLL for the present position, or the nearest one inside the limits.
    std::int64_t target_here() const;

    /// What must be done before a remedy that lets the motor turn, or it would leave the position limits.
    /// Empty: nothing.
    std::string before_it_turns() const;

  private:
    std::int64_t p_soll_of(std::int64_t place) const;

    const Condition& condition_;
};

/// In the order of urgency: no remedy in a row helps while a cause before it exists.
std::span<const Rule<Facts>> rules();

}  // namespace nplc::causes
