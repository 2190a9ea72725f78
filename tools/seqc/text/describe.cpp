#include "text/describe.h"

#include <fmt/format.h>

#include "meaning/commands.h"
#include "registers/mac.h"

namespace nplc::seqc {
namespace {

using sequencer::Condition;
using sequencer::FastStatement;
using sequencer::FlexStatement;

constexpr std::uint8_t kLastCommonRegister = 88;  // the same on all motors up to here

void join(std::string& text, std::string_view part, std::string_view separator) {
    if (!text.empty()) text += separator;
    text += part;
}

std::string step_name(std::uint8_t number, const Symbols* symbols) {
    if (symbols != nullptr && number < symbols->steps.size() && !symbols->steps[number].empty()) {
        return symbols->steps[number];
    }
    return fmt::format("step {}", number);
}

std::string condition_text(const Condition& condition, const Symbols* symbols) {
    std::string text;
    for (std::size_t bit = 0; bit < 7; ++bit) {
        if (((condition.care >> bit) & 1) == 0) continue;
        const std::string name = bit == 6             ? "INPOS"
                                 : symbols != nullptr ? symbols->inputs[bit]
                                                      : fmt::format("IN{}", bit);
        join(text, ((condition.input >> bit) & 1) != 0 ? name : "NOT " + name, " AND ");
    }
    if (condition.needs_timer_zero) join(text, "TIMER.Q", " AND ");
    if (condition.needs_counter_zero) join(text, "COUNTER.Q", " AND ");
    join(text, (condition.input & sequencer::kError) != 0 ? "ERROR" : "NOT ERROR", " AND ");
    return text;
}

std::string outputs_text(std::uint8_t outputs, const Symbols* symbols) {
    std::string text;
    for (std::size_t bit = 0; bit < 4; ++bit) {
        if (((outputs >> bit) & 1) == 0) continue;
        join(text, symbols != nullptr ? symbols->outputs[bit] : fmt::format("OUT{}", bit), ", ");
    }
    return "OUT " + (text.empty() ? std::string("none") : text);
}

std::string fast_text(const FastStatement& fast, const Symbols* symbols) {
    std::string text;
    if (fast.sends) join(text, describe_command(fast.command), "; ");
    join(text, outputs_text(fast.outputs, symbols), "; ");
    if (fast.preset != 0) {
        join(text,
             fast.presets_counter ? fmt::format("COUNTER := {}", fast.preset)
                                  : fmt::format("TIMER := T#{}ms", fast.preset),
             "; ");
    }
    if (fast.clears_counter) join(text, "CLEAR_COUNTER", "; ");
    if (fast.counts_down) join(text, "COUNT_DOWN", "; ");
    if (fast.next_step != sequencer::kNoSwitch) {
        join(text,
             fast.next_step == sequencer::kEndOfTable ? "NEXT := 63 (refused by a gateway)"
                                                      : "NEXT := " + step_name(fast.next_step, symbols),
             "; ");
    }
    return text;
}

std::string flex_text(const FlexStatement& flex, const Symbols* symbols) {
    if (flex.reg == 0) return "register 0 (refused by a gateway)";
    const auto model = symbols != nullptr ? symbols->motor : registers::Model::mac140;
    const bool name_known = symbols != nullptr || flex.reg <= kLastCommonRegister;
    const registers::Register* reg = name_known ? registers::find(model, flex.reg) : nullptr;
    const std::string name =
        reg != nullptr ? fmt::format("REG({}) {}", flex.reg, reg->name) : fmt::format("REG({})", flex.reg);
    if (flex.longword) {
        const auto value =
            static_cast<std::int32_t>((static_cast<std::uint32_t>(flex.high_word) << 16) | flex.low_word);
        return fmt::format("{} := {}, 32 bits", name, value);
    }
    const bool is_signed = reg != nullptr && reg->format != registers::Format::word;
    return fmt::format("{} := {}, 16 bits", name,
                       is_signed ? static_cast<std::int16_t>(flex.low_word) : std::int32_t{flex.low_word});
}

}  // namespace

std::string describe(sequencer::TermView bytes, const Symbols* symbols) {
    if (sequencer::is_end(bytes)) return "end of the table";
    const sequencer::Term term = sequencer::decode(bytes);
    return fmt::format("{}: IF {} THEN {}", step_name(term.condition.step, symbols),
                       condition_text(term.condition, symbols),
                       term.is_flex ? flex_text(term.flex, symbols) : fast_text(term.fast, symbols));
}

std::string byte_line(sequencer::TermView bytes) {
    std::string text = "TERM ";
    for (std::size_t i = 0; i < sequencer::kTermBytes; ++i)
        text += fmt::format("{}16#{:02X}", i == 0 ? "" : ", ", bytes[i]);
    return text + ";";
}

}  // namespace nplc::seqc
