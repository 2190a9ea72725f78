// Which words can be an order at all: ordered "POSITION(P2)", "POSITION(Long)", "V1 := 3146".
#include <fmt/format.h>

#include <algorithm>

#include "parser.h"
#include "registers/family.h"
#include "text/edit_distance.h"

namespace nplc::sim {
namespace {

constexpr unsigned kCommands = 128;  // a FastMAC command has 7 bits
constexpr unsigned kRegisters = 256;

const std::string* register_named(std::string_view name, const Names& names) {
    for (const auto& [own, reg] : names.registers) {
        if (same_name(own, name)) return &reg;
    }
    return nullptr;
}

/// `position(long)` as `position(p3)`, likewise what stands before `:=`.
std::string with_registers(const std::string& text, const Names& names) {
    const auto replaced = [&](std::size_t begin, std::size_t end) {
        const std::string* reg = register_named(std::string_view(text).substr(begin, end - begin), names);
        return reg == nullptr ? text : text.substr(0, begin) + normal_order(*reg) + text.substr(end);
    };
    if (const std::size_t sign = text.find(":="); sign != text.npos) return replaced(0, sign);
    const std::size_t open = text.find('(');
    if (open == text.npos || !text.ends_with(')')) return text;
    return replaced(open + 1, text.size() - 1);
}

std::string in_words_of(const SentOrder& order, const Names& names) {
    return normal_order(in_words(order, names.motor));
}

OrderReading read_write(const std::string& text, std::size_t sign, const Names& names) {
    const std::string name = text.substr(0, sign);
    const auto value = parse_integer(text.substr(sign + 2));
    for (unsigned number = 0; number < kRegisters; ++number) {
        SentOrder order{.is_register_write = true, .reg = static_cast<std::uint8_t>(number)};
        const std::string zero = in_words_of(order, names);
        if (zero.substr(0, zero.find(":=")) != name) continue;
        if (!value)
            return {.mistake =
                        fmt::format("an order has the register's own steps, as the timeline prints it, "
                                    "such as ordered \"{} := 100\"",
                                    registers::find(names.motor, order.reg) != nullptr
                                        ? registers::find(names.motor, order.reg)->name
                                        : name)};
        const registers::Register* reg = registers::find(names.motor, order.reg);
        const bool is_word = reg != nullptr && !registers::is_32_bit(reg->format);
        order.value = static_cast<std::uint32_t>(*value) & (is_word ? 0xFFFFU : 0xFFFFFFFFU);
        if (in_words_of(order, names) == normal_order(fmt::format("{}:={}", name, *value)))
            return {.order = in_words_of(order, names)};
        return {.mistake = fmt::format("{} is no value of {}, so this is never ordered", *value, name)};
    }
    return {.mistake =
                fmt::format("the motor has no register \"{}\", nor has the program a name for one", name)};
}

}  // namespace

OrderReading read_order(std::string_view text, const Names& names) {
    const std::string normal = with_registers(normal_order(std::string(text)), names);
    if (const std::size_t sign = normal.find(":="); sign != normal.npos)
        return read_write(normal, sign, names);
    std::vector<std::string> words;
    for (unsigned command = 0; command < kCommands; ++command) {
        words.push_back(in_words({.command = static_cast<std::uint8_t>(command)}, names.motor));
        if (normal_order(words.back()) == normal) return {.order = normal};
    }
    if (normal.find(',') != normal.npos)
        return {.mistake = "each register is an order of its own; write such as ordered \"INIT(V1)\""};
    const std::vector<std::string_view> known(words.begin(), words.end());
    const std::string_view meant = spelling::nearest(text, known);
    return {.mistake = fmt::format("\"{}\" can never be ordered; {}", text,
                                   meant.empty() ? "write an order as the timeline prints it, such as "
                                                   "POSITION(P2), RESET_ERROR or V1 := 3146"
                                                 : fmt::format("did you mean {}?", meant))};
}

}  // namespace nplc::sim
