#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "report/machine.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// `part` at the end of `text`, after `separator` if there is something before it.
void append(std::string& text, std::string_view part, std::string_view separator);

/// "Travel", "POWER_UP", or "step 5".
std::string step_name(std::uint8_t number, const Symbols* symbols);
/// "Start", or "NOT Start": the input's wire is on or off. "Estop" for one that is declared with AT NOT and
/// whose wire is off.
std::string input_text(std::size_t bit, bool level, const Symbols* symbols);
/// The same of any bit that a term can test: "NOT TIMER.Q".
std::string bit_text(std::size_t bit, bool level, const Symbols* symbols);
std::string output_name(std::size_t bit, const Symbols* symbols);

/// "Grip, Lamp"; empty for none.
std::string outputs_list(std::uint8_t outputs, const Symbols* symbols);

/// The register's description, if the motor is known or all motors have the same.
const registers::Register* find_register(std::uint8_t number, const Symbols* symbols);
/// "V1", or "REG(123)".
std::string register_name(std::uint8_t number, const Symbols* symbols);
/// The program's name, or as above.
std::string register_as_named(std::uint8_t number, const Symbols* symbols);
/// The written value as a number with the register's sign.
std::int64_t value_of(const sequencer::MotorOrder& write, const Symbols* symbols);

/// "POSITION(P2)", "V1 := 3146".
/// "GP_MODE" of a register that has names for its values; else the number.
std::string value_text(const sequencer::MotorOrder& write, const Symbols* symbols);
std::string order_text(const sequencer::MotorOrder& order, const Symbols* symbols);

/// "POSITION(Press)", "Fast := 1500 rpm": with the program's names and in its units.
std::string named_order_text(const sequencer::MotorOrder& order, const Symbols* symbols);

/// "T#500ms", "T#2s", "T#1s500ms"
std::string time_text(std::uint16_t milliseconds);

/// "POSITION(P2)", "TIMER := T#500ms", "COUNT_DOWN" and so on: everything except the next step and the
/// outputs.
std::vector<std::string> action_texts(const table::Outcome& outcome, const Symbols* symbols);

/// A condition that is true in all cases of `need` and in none outside of `need` and `open`: "Start AND NOT
/// Guard". As in the language it implies NOT ERROR unless it names ERROR. "always" without a condition.
std::string condition_text(const Truth& need, const Truth& open, const Symbols* symbols);

/// "1500 rpm" for 3146 in V1: the shortest number that the compiler rounds to this value. Empty for a
/// register without unit, or if the motor is unknown.
std::optional<std::string> with_unit(std::int64_t value, std::uint8_t reg, const Symbols* symbols);
/// The same, and velocities and accelerations in the unit of the program's SCALE.
std::optional<std::string> with_machine_unit(std::int64_t value, std::uint8_t reg, const Symbols* symbols);

/// The action of a step in one case, in a form for comparing two tables.
struct StepAction {
    int next_id = -1;  ///< id of the next step, common to both tables; -1 if it stays
    std::string next;  ///< its name
    std::vector<sequencer::MotorOrder> orders;
    std::uint16_t timer = 0;
    table::CounterChange counter = table::CounterChange::none;
    std::uint16_t counter_preset = 0;
    KnownOutputs outputs;           ///< where two tables differ and the steps themselves do not determine it
    std::uint8_t kept_outputs = 0;  ///< outputs without a certain value
    bool operator==(const StepAction& other) const;
};

/// The action of a scan in case `c`, without the next step. Counter operations without effect at zero are
/// omitted.
StepAction step_action_of(const table::Outcome& outcome, std::size_t c);

/// "sends STOP and goes to Fault"; "nothing".
std::string text_of(const StepAction& action, const Symbols* symbols);

}  // namespace nplc::seqc
