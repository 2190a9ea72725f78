#include "compiler/name_table.h"

#include <fmt/format.h>

#include <cmath>

#include "language/names.h"
#include "symbols/units.h"

namespace nplc::seqc {
namespace {

/// For properties and scenarios.
void note_time(const ast::Constant& constant, Symbols& symbols) {
    const ast::Value& value = constant.value;
    const bool is_seconds = same_name(value.unit.text, "s");
    if (!value.is_time && !is_seconds && !same_name(value.unit.text, "ms")) return;
    const double milliseconds = value.number * (is_seconds ? 1000 : 1);
    constexpr double kLongestName = 3'600'000;
    if (milliseconds >= 0 && milliseconds <= kLongestName && milliseconds == std::floor(milliseconds))
        symbols.times.push_back({std::string(constant.name.text), static_cast<std::uint32_t>(milliseconds)});
}

}  // namespace

const DeclaredName* find_name(const std::vector<DeclaredName>& names, std::string_view name) {
    for (const DeclaredName& declared : names) {
        if (same_name(declared.name, name)) return &declared;
    }
    return nullptr;
}

std::optional<std::size_t> address_number(std::string_view text, char direction) {
    const std::string address = upper(text);
    const std::string_view plain = direction == 'I' ? "IN" : "OUT";
    const std::string located = fmt::format("%{}X0.", direction);
    const std::string_view prefix = address.starts_with('%') ? std::string_view(located) : plain;
    if (!address.starts_with(prefix) || address.size() == prefix.size() ||
        address.size() > prefix.size() + 2) {
        return std::nullopt;
    }
    const bool has_zero_before = address.size() > prefix.size() + 1 && address[prefix.size()] == '0';
    if (has_zero_before) return std::nullopt;
    std::size_t number = 0;
    for (char c : address.substr(prefix.size())) {
        if (c < '0' || c > '9') return std::nullopt;
        number = number * 10 + static_cast<std::size_t>(c - '0');
    }
    return number;
}

NameTable::NameTable(const ast::Program& program, const ChosenMotor& motor, Report& report)
    : motor_(motor), report_(report), constants_(report), names_missing_(program.names_missing) {
    for (std::string_view name : program.faulty_names) add_faulty(name);
    for (const ast::Use& use : program.uses) {
        if (use.declares) declared_.emplace(use.span.offset, declared_.size());
    }
}

void NameTable::declare_constants(const ast::Program& program, Symbols& symbols) {
    for (const ast::Constant& constant : program.constants) {
        if (!is_new(constant.name)) continue;
        if (is_known_unit(constant.name.text) ||
            (motor_.length() && same_name(motor_.length()->name, constant.name.text))) {
            report_.add("E011", constant.name.span, fmt::format("'{}' is a unit", constant.name.text),
                        "choose another name");
        } else if (constants_.declare(constant)) {
            note_time(*constants_.find(constant.name.text), symbols);
            continue;
        }
        add_faulty(constant.name.text);
    }
}

bool NameTable::is_new(const ast::Name& name) {
    const auto refuse_twice = [&](Span other) {
        const bool is_later = stands_before(other, name.span);
        report_
            .add("E020", is_later ? name.span : other, fmt::format("'{}' is declared twice", name.text),
                 "choose another name")
            .notes.push_back({is_later ? other : name.span, "the first declaration is here"});
    };
    const std::string_view text = name.text;
    if (address_number(text, 'I') || address_number(text, 'Q') ||
        registers::find(motor_.model(), text) != nullptr) {
        report_.add("E011", name.span,
                    fmt::format("'{}' has a meaning already: {}", text,
                                registers::find(motor_.model(), text) ? "it is a register of the motor"
                                                                      : "it is an address"),
                    "choose another name");
        add_faulty(text);
        return false;
    }
    if (const ast::Constant* earlier = constants_.find(text)) {
        refuse_twice(earlier->name.span);
        add_faulty(text);
        return false;
    }
    for (const auto* variables : {&inputs_, &outputs_, &registers_}) {
        const DeclaredName* earlier = find_name(*variables, text);
        if (earlier == nullptr) continue;
        refuse_twice(earlier->span);
        return false;
    }
    return true;
}

bool NameTable::stands_before(Span a, Span b) const {
    const auto first = declared_.find(a.offset);
    const auto second = declared_.find(b.offset);
    if (first == declared_.end() || second == declared_.end()) return a.offset < b.offset;
    return first->second < second->second;
}

void NameTable::note_declaration(Diagnostic& diagnostic, std::string_view name) const {
    const DeclaredName* variable = find_name(registers_, name);
    if (variable == nullptr) return;
    diagnostic.notes.push_back(
        {variable->span, fmt::format("'{}' is {}, declared here", variable->name, variable->reg->name)});
}

void NameTable::add_faulty(std::string_view name) {
    faulty_.insert(upper(name));
}

bool NameTable::is_faulty(std::string_view name) {
    const bool known = names_missing_ || faulty_.contains(upper(name));
    if (known) ++faulty_met_;
    return known;
}

}  // namespace nplc::seqc
