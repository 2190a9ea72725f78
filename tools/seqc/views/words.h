#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "seqc/seqc.h"
#include "terms/scan.h"

/// Parts of a table in the language's words. Without symbols steps and signals go by number.
namespace nplc::seqc {

/// `part` at the end of `text`, after `separator` if there is something before it.
void append(std::string& text, std::string_view part, std::string_view separator);

/// "Travel", "POWER_UP", or "step 5".
std::string step_name(std::uint8_t number, const Symbols* symbols);
std::string input_name(std::size_t bit, const Symbols* symbols);
std::string output_name(std::size_t bit, const Symbols* symbols);

/// "Grip, Lamp"; empty for none.
std::string outputs_list(std::uint8_t outputs, const Symbols* symbols);

/// The register's entry, where the motor is known or all motors have the same there.
const registers::Register* find_register(std::uint8_t number, const Symbols* symbols);
/// "V1", or "REG(123)".
std::string register_name(std::uint8_t number, const Symbols* symbols);
/// What is written, as a number with the register's sign.
std::int64_t value_of(const sequencer::MotorOrder& write, const Symbols* symbols);

/// "POSITION(P2)", "V1 := 3146".
std::string order_text(const sequencer::MotorOrder& order, const Symbols* symbols);

/// "POSITION(P2)", "TIMER := T#500ms", "COUNT_DOWN" and so on: all but the next step and the outputs.
std::vector<std::string> action_texts(const Outcome& outcome, const Symbols* symbols);

/// A condition that holds in all cases of `need` and in none outside of `need` and `open`: "Start AND NOT
/// Guard". As in the language it means NOT ERROR unless it names ERROR. "always" for no condition at all.
std::string condition_text(const Truth& need, const Truth& open, const Symbols* symbols);

}  // namespace nplc::seqc
