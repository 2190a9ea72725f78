#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compiler/model.h"
#include "report/decompile/naming.h"
#include "sequencer/term.h"

namespace nplc::seqc {

/// Names, units and motor of the program to be written.
struct WriterContext {
    const Naming& naming;
    registers::Model motor;
    bool motor_is_sure = true;  ///< false: registers that differ between motors are written as numbers
    bool has_power_up = true;   ///< step 0 is POWER_UP
};

/// A statement without its prefix and suffix.
struct Line {
    std::string text;     ///< with its semicolon
    std::string comment;  ///< without the slashes; may be empty
};

/// The effects of an action except its NEXT, in program order.
std::vector<Line> statements_of(const Action& action, const WriterContext& context);

std::string next_text(std::uint8_t step, const WriterContext& context);

/// "OUT Grip, Lamp;"; `outputs` is not 0.
std::string outputs_text(std::uint8_t outputs, const Naming& naming);

/// The register's given name such as "Place"; else as register_address().
std::string register_text(const registers::Register& reg, const WriterContext& context);
/// "P2", or "REG(200)".
std::string register_address(const registers::Register& reg, const WriterContext& context);

/// The line of one term: symbolic, or as bytes with the reason and the meaning in a comment. `inside`: within
/// its step, so that it needs no step name.
Line term_line(sequencer::TermView term, bool inside, const WriterContext& context);

}  // namespace nplc::seqc
