#include "listing/describe.h"

#include <fmt/format.h>

#include "semantics/commands.h"
#include "views/table_text.h"

namespace nplc::seqc {
namespace {

using sequencer::Condition;
using sequencer::FastStatement;
using sequencer::FlexStatement;

std::string term_condition_text(const Condition& condition, const Symbols* symbols) {
    std::string text;
    for (std::size_t bit = 0; bit < 7; ++bit) {
        if (((condition.care >> bit) & 1) == 0) continue;
        const std::string name = bit == 6 ? "INPOS" : input_name(bit, symbols);
        append(text, ((condition.input >> bit) & 1) != 0 ? name : "NOT " + name, " AND ");
    }
    if (condition.needs_timer_zero) append(text, "TIMER.Q", " AND ");
    if (condition.needs_counter_zero) append(text, "COUNTER.Q", " AND ");
    append(text, (condition.input & sequencer::kError) != 0 ? "ERROR" : "NOT ERROR", " AND ");
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

std::string flex_text(const FlexStatement& flex, const Symbols* symbols) {
    if (flex.reg == 0) return "register 0 (refused by a gateway)";
    const registers::Register* reg = find_register(flex.reg, symbols);
    const std::string name =
        reg != nullptr ? fmt::format("REG({}) {}", flex.reg, reg->name) : fmt::format("REG({})", flex.reg);
    const sequencer::MotorOrder write{
        .is_register_write = true,
        .reg = flex.reg,
        .longword = flex.longword,
        .value = flex.longword ? (std::uint32_t{flex.high_word} << 16) | flex.low_word : flex.low_word};
    const std::string number = std::to_string(value_of(write, symbols));
    const std::string value = value_text(write, symbols);
    return fmt::format("{} := {}{}, {} bits", name, number, value == number ? "" : " (" + value + ")",
                       flex.longword ? 32 : 16);
}

}  // namespace

std::string describe(sequencer::TermView bytes, const Symbols* symbols) {
    if (sequencer::is_end(bytes)) return "end of the table";
    const sequencer::Term term = sequencer::decode(bytes);
    return fmt::format("{}: IF {} THEN {}", step_name(term.condition.step, symbols),
                       term_condition_text(term.condition, symbols),
                       term.is_flex ? flex_text(term.flex, symbols) : fast_text(term.fast, symbols));
}

std::string byte_line(sequencer::TermView bytes) {
    std::string text = "TERM ";
    for (std::size_t i = 0; i < sequencer::kTermBytes; ++i)
        text += fmt::format("{}16#{:02X}", i == 0 ? "" : ", ", bytes[i]);
    return text + ";";
}

}  // namespace nplc::seqc
