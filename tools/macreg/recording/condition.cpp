#include "macreg/condition.h"

#include <fmt/format.h>

#include <array>

#include "macreg/values.h"

namespace nplc::macreg {
namespace {

using Relation = Comparison::Relation;

struct Sign {
    std::string_view text;
    Relation relation;
};
// Longer ones first.
constexpr std::array<Sign, 8> kSigns{{{"<=", Relation::at_most},
                                      {">=", Relation::at_least},
                                      {"==", Relation::equal},
                                      {"!=", Relation::unequal},
                                      {"<", Relation::less},
                                      {">", Relation::more},
                                      {"=", Relation::equal},
                                      {"&", Relation::any_bit}}};

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    return text;
}

}  // namespace

bool Comparison::holds(std::int64_t value) const {
    switch (relation) {
        case Relation::less:
            return value < raw;
        case Relation::at_most:
            return value <= raw;
        case Relation::equal:
            return value == raw;
        case Relation::unequal:
            return value != raw;
        case Relation::at_least:
            return value >= raw;
        case Relation::more:
            return value > raw;
        case Relation::any_bit:
            return (value & raw) != 0;
    }
    return false;
}

ConditionReading read_condition(std::string_view text, registers::Model model) {
    const std::size_t at = text.find_first_of("<>=!&");
    const Sign* sign = nullptr;
    if (at != std::string_view::npos) {
        for (const Sign& one : kSigns) {
            if (sign == nullptr && text.substr(at).starts_with(one.text)) sign = &one;
        }
    }
    if (sign == nullptr)
        return {.error = fmt::format("'{}' is no condition; write a register, one of < <= == != >= > & and a "
                                     "value, such as 'V_IST>100 rpm'",
                                     text)};
    const NamedRegister named = find_register(model, trimmed(text.substr(0, at)));
    if (named.reg == nullptr) return {.error = fmt::format("'{}': {}", text, named.error)};
    const TypedValue value = typed_value(*named.reg, model, trimmed(text.substr(at + sign->text.size())));
    if (!value.error.empty()) return {.error = fmt::format("'{}': {}", text, value.error)};
    return {.condition = {named.reg, sign->relation, value.raw}};
}

std::string condition_words(const Comparison& condition, registers::Model model) {
    std::string_view sign;
    for (const Sign& one : kSigns) {
        if (sign.empty() && one.relation == condition.relation) sign = one.text;
    }
    return fmt::format("{} {} {}", condition.reg->name, sign,
                       value_text(*condition.reg, model, condition.raw));
}

}  // namespace nplc::macreg
