#include "report/describe.h"

#include <fmt/format.h>

#include "report/table_text.h"
#include "sequencer/state.h"
#include "symbols/commands.h"
#include "table/terms.h"

namespace nplc::seqc {
namespace {

using sequencer::FastStatement;

std::string term_condition_text(sequencer::TermView term, const Symbols* symbols) {
    std::string text;
    for (const table::Compared& compared : table::compared_by(term))
        append(text, bit_text(compared.key_bit, compared.level, symbols), " AND ");
    return text;
}

std::string fast_text(const FastStatement& fast, const Symbols* symbols) {
    std::string text;
    if (fast.sends) append(text, describe_command(fast.command), "; ");
    const std::string outputs = outputs_list(fast.outputs, symbols);
    append(text, "OUT " + (outputs.empty() ? "none" : outputs), "; ");
    if (fast.preset != 0) {
        append(text,
               fast.presets_counter ? fmt::format("COUNTER := {}", fast.preset)
                                    : fmt::format("TIMER := T#{}ms", fast.preset),
               "; ");
    }
    if (fast.clears_counter) append(text, "CLEAR_COUNTER", "; ");
    if (fast.counts_down) append(text, "COUNT_DOWN", "; ");
    if (fast.next_step != sequencer::kNoSwitch) {
        append(text,
               fast.next_step == sequencer::kEndOfTable ? "NEXT := 63 (refused by a gateway)"
                                                        : "NEXT := " + step_name(fast.next_step, symbols),
               "; ");
    }
    return text;
}

std::string write_text(const sequencer::MotorOrder& write, const Symbols* symbols) {
    const registers::Register* reg = find_register(write.reg, symbols);
    const std::string name =
        reg != nullptr ? fmt::format("REG({}) {}", write.reg, reg->name) : fmt::format("REG({})", write.reg);
    const std::string number = std::to_string(value_of(write, symbols));
    const std::string value = value_text(write, symbols);
    return fmt::format("{} := {}{}, {} bits", name, number, value == number ? "" : " (" + value + ")",
                       write.longword ? 32 : 16);
}

std::string statement_text_of(sequencer::TermView term, const Symbols* symbols) {
    if (table::fault_of(term) == table::TermFault::register_0) return "register 0 (refused by a gateway)";
    return sequencer::is_flex(term) ? write_text(sequencer::order_of(term), symbols)
                                    : fast_text(sequencer::decode(term).fast, symbols);
}

}  // namespace

std::string describe(sequencer::TermView term, const Symbols* symbols) {
    if (sequencer::is_end(term)) return "end of the table";
    return fmt::format("{}: IF {} THEN {}", step_name(sequencer::step_of(term), symbols),
                       term_condition_text(term, symbols), statement_text_of(term, symbols));
}

std::string byte_line(sequencer::TermView term) {
    std::string text;
    for (const std::uint8_t byte : term) append(text, fmt::format("16#{:02X}", byte), ", ");
    return "TERM " + text + ";";
}

}  // namespace nplc::seqc
