#include "compiler/constants.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "language/names.h"
#include "registers/details.h"
#include "symbols/units.h"

namespace nplc::seqc {
namespace {

using ast::Value;
using Kind = ast::Value::Kind;

bool has_dimension(const Value& value) {
    return value.is_time || !value.unit.text.empty();
}

bool is_time(const Value& value) {
    return value.is_time || same_name(value.unit.text, "s") || same_name(value.unit.text, "ms");
}

/// Times in milliseconds, so that they can be added.
Value as_time(Value value) {
    if (same_name(value.unit.text, "s")) value.number *= 1000;
    value.unit = {};
    value.is_time = true;
    return value;
}

std::string dimension_of(const Value& value) {
    if (value.is_raw) return "bits of a register";
    if (value.is_time) return "a time";
    return value.unit.text.empty() ? "a plain number" : fmt::format("'{}'", value.unit.text);
}

bool is_same_dimension(const Value& a, const Value& b) {
    return a.is_time == b.is_time && same_name(a.unit.text, b.unit.text);
}

void keep_name(Value& value, const Value& other) {
    if (value.name.text.empty()) value.name = other.name;
}

}  // namespace

bool Constants::declare(const ast::Constant& constant) {
    const std::size_t errors = report_.error_count();
    const auto value = worked_out(constant.value, nullptr, registers::Model::mac140);
    if (!value) {
        if (unknown_ != nullptr && report_.error_count() == errors) {
            const std::string near =
                report_.full_of_errors() ? std::string() : suggestion(unknown_->text, names());
            report_.add("E021", unknown_->span,
                        fmt::format("there is no constant '{}' above this line", unknown_->text),
                        !near.empty()
                            ? near
                            : "a constant may name those above it; names of modes and bits stand where "
                              "a register gets its value");
        }
        return false;
    }
    places_.try_emplace(upper(constant.name.text), constants_.size());
    constants_.push_back({constant.name, *value});
    return true;
}

void Constants::declare_register(const ast::Name& name, const ast::Value& value) {
    registers_.push_back({name, value});
}

const ast::Constant* Constants::find(std::string_view name) const {
    if (constants_.empty()) return nullptr;
    const auto place = places_.find(upper(name));
    return place == places_.end() ? nullptr : &constants_[place->second];
}

std::vector<std::string_view> Constants::names() const {
    std::vector<std::string_view> result;
    for (const ast::Constant& constant : constants_) result.push_back(constant.name.text);
    return result;
}

std::optional<Value> Constants::worked_out(const Value& value, const registers::Register* reg,
                                           registers::Model model) {
    reg_ = reg;
    model_ = model;
    unknown_ = nullptr;
    registers_met_.clear();
    Result result = evaluate(value);
    if (!result) return std::nullopt;
    result->span = value.span;
    if (std::isfinite(result->number)) return result;
    return refuse(value.span, "this is too large for any register", "write a smaller value");
}

Constants::Result Constants::evaluate(const Value& value) {
    switch (value.kind) {
        case Kind::literal:
            return literal(value);
        case Kind::name:
            return named(value);
        case Kind::part:
            return part(value);
        case Kind::sum:
            return sum(value);
        case Kind::product:
            return product(value);
        case Kind::negation:
        case Kind::inverse:
            break;
    }
    Result result = evaluate(value.operands.front());
    if (!result) return result;
    if (result->is_raw) return refuse(value.span, "bits of a register have no sign", "write them without it");
    result->number = -result->number;
    return result;
}

/// `40 mm/Pieces` is parsed as a unit: the word after the last / may still be a constant.
Constants::Result Constants::literal(const Value& value) {
    if (constants_.empty() || value.unit.text.empty() || is_known_unit(value.unit.text)) return value;
    if (const ast::Constant* factor = find(value.unit.text)) {
        return refuse(value.span, fmt::format("'{}' is a constant and no unit", value.unit.text),
                      fmt::format("write {:g} * {}", value.number, factor->name.text));
    }
    const std::size_t slash = value.unit.text.rfind('/');
    if (slash == std::string_view::npos) return value;
    const ast::Constant* divisor = find(value.unit.text.substr(slash + 1));
    if (divisor == nullptr) return value;
    Value dividend = value;
    dividend.unit.text = value.unit.text.substr(0, slash);
    Result left = literal(dividend);
    if (!left) return left;
    Value right = divisor->value;
    right.span = value.span;
    return divided(std::move(*left), right);
}

Constants::Result Constants::named(const Value& value) {
    if (const ast::Constant* constant = find(value.name.text)) {
        Value result = constant->value;
        result.span = value.span;
        result.name = value.name;
        return result;
    }
    for (const ast::Constant& named : registers_) {
        if (!names_registers_ || !same_name(named.name.text, value.name.text)) continue;
        registers_met_.push_back(named.value.span);
        Value result = named.value;
        result.span = value.span;
        return result;
    }
    return bits(value,
                reg_ == nullptr ? std::nullopt : registers::bits_named(model_, *reg_, value.name.text));
}

Constants::Result Constants::part(const Value& value) {
    if (reg_ == nullptr) return bits(value, std::nullopt);
    const Value& chosen = value.operands.front();
    if (chosen.kind == Kind::name) {
        const auto found = registers::bits_named(model_, *reg_, value.name.text, chosen.name.text);
        if (!found && registers::field_of(model_, reg_->number, value.name.text) != nullptr)
            unknown_ = &chosen.name;
        return unknown_ != nullptr ? std::nullopt : bits(value, found);
    }
    const registers::Field* field = registers::field_of(model_, reg_->number, value.name.text);
    if (field == nullptr) return bits(value, std::nullopt);
    const double most = registers::mask_of(*field) >> field->first;
    const bool fits = !has_dimension(chosen) && chosen.number >= 0 && chosen.number <= most &&
                      std::floor(chosen.number) == chosen.number;
    if (!fits)
        return refuse(chosen.span, fmt::format("{} takes 0 .. {:g}", field->name, most),
                      "write one of these");
    return bits(value, static_cast<std::uint32_t>(chosen.number) << field->first);
}

Constants::Result Constants::bits(const Value& value, std::optional<std::uint32_t> found) {
    if (!found) {
        unknown_ = &value.name;
        return std::nullopt;
    }
    Value result;
    result.span = value.span;
    result.number = *found;
    result.is_raw = true;
    return result;
}

Constants::Result Constants::sum(const Value& value) {
    Result total = evaluate(value.operands.front());
    for (std::size_t i = 1; total && i < value.operands.size(); ++i) {
        const Result operand = evaluate(value.operands[i]);
        if (!operand) return std::nullopt;
        total = added(std::move(*total), *operand);
    }
    return total;
}

Constants::Result Constants::added(Value left, const Value& right) {
    keep_name(left, right);
    if (left.is_raw && right.is_raw) {
        left.number = static_cast<std::uint32_t>(left.number) | static_cast<std::uint32_t>(right.number);
        return left;
    }
    if (is_time(left) && is_time(right)) {
        left = as_time(std::move(left));
        left.number += as_time(right).number;
        return left;
    }
    if (left.is_raw || right.is_raw || !is_same_dimension(left, right)) {
        return refuse(right.span,
                      fmt::format("{} cannot be added to {}", dimension_of(right), dimension_of(left)),
                      "write both in one unit");
    }
    left.number += right.number;
    return left;
}

Constants::Result Constants::product(const Value& value) {
    Result total = evaluate(value.operands.front());
    for (std::size_t i = 1; total && i < value.operands.size(); ++i) {
        const Value& operand = value.operands[i];
        const bool divides = operand.kind == Kind::inverse;
        const Result factor = evaluate(divides ? operand.operands.front() : operand);
        if (!factor) return std::nullopt;
        total = divides ? divided(std::move(*total), *factor) : multiplied(std::move(*total), *factor);
    }
    return total;
}

Constants::Result Constants::multiplied(Value left, const Value& right) {
    if (left.is_raw || right.is_raw || (has_dimension(left) && has_dimension(right))) {
        return refuse(right.span,
                      fmt::format("{} cannot be multiplied by {}", dimension_of(left), dimension_of(right)),
                      "one of the two is a plain number, as in 2 * 40 mm");
    }
    Value result = has_dimension(right) ? right : left;
    keep_name(result, left);
    keep_name(result, right);
    result.number = left.number * right.number;
    return result;
}

Constants::Result Constants::divided(Value left, const Value& right) {
    const bool ratio = has_dimension(right) && is_same_dimension(left, right);
    if (left.is_raw || right.is_raw || (has_dimension(right) && !ratio)) {
        const bool has_its_unit = !left.is_raw && !has_dimension(left) && !right.unit.text.empty();
        return refuse(right.span,
                      fmt::format("{} cannot be divided by {}", dimension_of(left), dimension_of(right)),
                      has_its_unit ? fmt::format("the unit goes to the first number: {} {} / {}", left.number,
                                                 right.unit.text, right.number)
                                   : "divide by a plain number, as in 360 deg / 7");
    }
    if (right.number == 0) return refuse(right.span, "this divides by 0", "write another divisor");
    keep_name(left, right);
    left.number /= right.number;
    if (!ratio) return left;
    left.unit = {};
    left.is_time = false;
    return left;
}

std::nullopt_t Constants::refuse(Span span, std::string message, std::string help) {
    report_.add("E045", span, std::move(message), std::move(help));
    return std::nullopt;
}

}  // namespace nplc::seqc
