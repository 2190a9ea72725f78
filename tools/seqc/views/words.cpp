#include "views/words.h"

#include <fmt/format.h>

#include "meaning/commands.h"

namespace nplc::seqc {
namespace {

constexpr std::uint8_t kLastCommonRegister = 88;  // the same on all motors up to here

}  // namespace

void append(std::string& text, std::string_view part, std::string_view separator) {
    if (!text.empty() && !part.empty()) text += separator;
    text += part;
}

std::string step_name(std::uint8_t number, const Symbols* symbols) {
    if (symbols != nullptr && number < symbols->steps.size() && !symbols->steps[number].empty())
        return symbols->steps[number];
    return fmt::format("step {}", number);
}

std::string input_name(std::size_t bit, const Symbols* symbols) {
    return symbols != nullptr ? symbols->inputs[bit] : fmt::format("IN{}", bit);
}

std::string output_name(std::size_t bit, const Symbols* symbols) {
    return symbols != nullptr ? symbols->outputs[bit] : fmt::format("OUT{}", bit);
}

std::string outputs_list(std::uint8_t outputs, const Symbols* symbols) {
    std::string text;
    for (std::size_t bit = 0; bit < 4; ++bit) {
        if (((outputs >> bit) & 1) != 0) append(text, output_name(bit, symbols), ", ");
    }
    return text;
}

const registers::Register* find_register(std::uint8_t number, const Symbols* symbols) {
    if (symbols == nullptr && number > kLastCommonRegister) return nullptr;
    return registers::find(symbols != nullptr ? symbols->motor : registers::Model::mac140, number);
}

std::string register_name(std::uint8_t number, const Symbols* symbols) {
    const registers::Register* reg = find_register(number, symbols);
    return reg != nullptr ? std::string(reg->name) : fmt::format("REG({})", number);
}

std::int64_t value_of(const sequencer::MotorOrder& write, const Symbols* symbols) {
    if (write.longword) return static_cast<std::int32_t>(write.value);
    const registers::Register* reg = find_register(write.reg, symbols);
    const bool is_signed = reg != nullptr && reg->format != registers::Format::word;
    return is_signed ? static_cast<std::int16_t>(write.value) : static_cast<std::int64_t>(write.value);
}

std::string order_text(const sequencer::MotorOrder& order, const Symbols* symbols) {
    if (!order.is_flex) return describe_command(order.command);
    return fmt::format("{} := {}", register_name(order.reg, symbols), value_of(order, symbols));
}

std::vector<std::string> action_texts(const Outcome& outcome, const Symbols* symbols) {
    std::vector<std::string> texts;
    for (const auto& order : outcome.orders) texts.push_back(order_text(order, symbols));
    if (outcome.timer != 0) texts.push_back(fmt::format("TIMER := T#{}ms", outcome.timer));
    switch (outcome.counter) {
        case CounterChange::none:
            break;
        case CounterChange::clear:
            texts.emplace_back("CLEAR_COUNTER");
            break;
        case CounterChange::preset:
            texts.push_back(fmt::format("COUNTER := {}", outcome.counter_preset));
            break;
        case CounterChange::count_down:
            texts.emplace_back("COUNT_DOWN");
            break;
    }
    return texts;
}

}  // namespace nplc::seqc
