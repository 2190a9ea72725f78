#include "vacuous.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string_view>

#include "monitor.h"

namespace nplc::verify {
namespace {

/// The part of a property's text after `begin` and before the first of `ends`.
std::string part_of(const std::string& text, std::string_view begin,
                    std::initializer_list<std::string_view> ends) {
    std::string upper = text;
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    const std::size_t at = upper.find(begin);
    if (at == std::string::npos) return "its condition";
    const std::size_t from = at + begin.size();
    std::size_t to = text.size();
    for (const std::string_view end : ends) to = std::min(to, upper.find(end, from));
    return text.substr(from, to - from);
}

std::string never_holds(const Property& property) {
    const auto holds = [](const std::string& what) { return what + " never holds"; };
    const std::string& text = property.text;
    switch (property.form) {
        case Form::never:
        case Form::whenever:
            return holds(part_of(text, "WHENEVER ", {" THEN "}));
        case Form::never_while:
            if (text.find("WHILE ") == std::string::npos) return holds(part_of(text, "WHENEVER ", {" FOR "}));
            return holds(part_of(text, "WHILE ", {" FOR "}));
        case Form::after_possible:
            return holds(part_of(text, "AFTER ", {" ALWAYS "}));
        case Form::followed_by:
            return part_of(text, "WHENEVER ", {" THEN "}) + " never happens";
        case Form::stays:
            return "BETWEEN never begins";
        case Form::scan_ends:
            return part_of(text, "FROM ", {" ENDS "}) + " never holds when a scan begins";
        case Form::changes_only_in:
            return part_of(text, "", {" CHANGES "}) + " never changes";
        default:
            return holds(part_of(text, "", {" ONLY "}));
    }
}

/// The same property without what fulfils it.
Property unfulfilled(Property property) {
    if (property.form != Form::stays && property.form != Form::followed_by) property.then = {};
    property.third = {};
    return property;
}

/// Whether the assumptions about inputs alone prove a NEVER or an ALWAYS, for any table.
bool is_ruled_out(const Machine& machine, const Property& property) {
    if (machine.permitted().all()) return false;
    const Target target{.condition = &property.condition, .negated = property.form == Form::always};
    bool is_there_without = false;
    for (unsigned number = 0; number < 64U * 128U; ++number) {
        const View view{.step = static_cast<std::uint8_t>(number % 64U),
                        .outputs = static_cast<std::uint8_t>(number / 64U % 16U),
                        .timer_zero = (number & 1024U) != 0,
                        .counter_zero = (number & 2048U) != 0,
                        .moving = (number & 4096U) != 0};
        const ImageSet images = target.images(view);
        if ((images & machine.permitted()).any()) return false;
        is_there_without = is_there_without || images.any();
    }
    return is_there_without;
}

}  // namespace

Target subject_of(const Property& property) {
    if (property.is_implied) return {.condition = &property.condition.operands.front()};
    const bool is_second = property.form == Form::never_while || property.form == Form::after_possible;
    return {.condition = is_second ? &property.then : &property.condition};
}

std::string why_vacuous(const Explorer& explorer, const Property& property, bool is_met) {
    switch (property.form) {
        case Form::reachable:
        case Form::always_possible:
            return "";
        case Form::never:
            if (property.is_implied) return is_met || !explorer.complete() ? "" : never_holds(property);
            [[fallthrough]];
        case Form::always:
            return is_ruled_out(explorer.machine(), property)
                       ? "the assumptions about inputs alone rule it out"
                       : "";
        case Form::whenever:
        case Form::never_while:
        case Form::after_possible:
            return is_met || !explorer.complete() ? "" : never_holds(property);
        default:
            if (!explorer.has_all_edges() || breaking_course(explorer, unfulfilled(property))) return "";
            return never_holds(property);
    }
}

}  // namespace nplc::verify
