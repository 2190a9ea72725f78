#include "vacuous.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <numeric>
#include <string_view>
#include <vector>

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

/// Operand `number` of `count` of the AND in a NEVER, as written if it has no parentheses.
std::string part_in_words(const std::string& text, std::size_t number, std::size_t count) {
    std::string rest = part_of(text, "NEVER ", {});
    std::vector<std::string> parts;
    std::string upper = rest;
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    std::size_t from = 0;
    for (std::size_t at = upper.find(" AND "); at != std::string::npos; at = upper.find(" AND ", from)) {
        parts.push_back(rest.substr(from, at - from));
        from = at + std::string_view(" AND ").size();
    }
    parts.push_back(rest.substr(from));
    const bool is_plain = rest.find('(') == std::string::npos && parts.size() == count;
    return is_plain ? parts[number] : "one part of its condition";
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

/// The steps that the table has, or can go to.
std::uint64_t steps_of(const Machine& machine) {
    std::uint64_t steps = machine.steps_with_terms() | 1U;
    for (std::uint8_t step = 0; step <= sequencer::kLastStep; ++step) {
        if (((machine.steps_with_terms() >> step) & 1U) == 0) continue;
        for (unsigned zeros = 0; zeros < 4; ++zeros) {
            for (const Group& group : machine.groups(step, (zeros & 1U) != 0, (zeros & 2U) != 0))
                steps |= std::uint64_t{1} << group.outcome.next;
        }
    }
    return steps;
}

/// Why nothing can break a NEVER or an ALWAYS, whatever is in the table's steps; empty if something can.
std::string why_ruled_out(const Machine& machine, const Property& property) {
    const Target target{.condition = &property.condition, .negated = property.form == Form::always};
    const std::uint64_t steps = steps_of(machine);
    bool is_there_in_a_step = false;
    bool is_there = false;
    for (unsigned number = 0; number < 64U * 128U; ++number) {
        const View view{.step = static_cast<std::uint8_t>(number % 64U),
                        .outputs = static_cast<std::uint8_t>(number / 64U % 16U),
                        .timer_zero = (number & 1024U) != 0,
                        .counter_zero = (number & 2048U) != 0,
                        .moving = (number & 4096U) != 0};
        const ImageSet images = target.images(view);
        is_there = is_there || images.any();
        if (images.none() || ((steps >> view.step) & 1U) == 0) continue;
        is_there_in_a_step = true;
        if ((images & machine.permitted()).any()) return "";
    }
    if (is_there_in_a_step) return "the assumptions about inputs alone rule it out";
    if (is_there) return "it asks for a step that the table does not have";
    return property.form == Form::always
               ? "its condition always holds, whatever the machine does"
               : "its condition contradicts itself, and never holds whatever the machine does";
}

void add_parts(const Condition& condition, std::vector<const Condition*>& parts) {
    if (condition.kind != Condition::Kind::all_of) return parts.push_back(&condition);
    for (const Condition& operand : condition.operands) add_parts(operand, parts);
}

/// The first part of a NEVER's AND that never holds by itself, in words; empty if there is none.
std::string part_that_never_holds(const Explorer& explorer, const Property& property) {
    std::vector<const Condition*> parts;
    add_parts(property.condition, parts);
    if (parts.size() < 2 || !explorer.has_all_edges()) return "";
    std::vector<std::size_t> open(parts.size());
    std::iota(open.begin(), open.end(), std::size_t{0});
    for (const Explorer::Edge& edge : explorer.edges()) {
        if (open.empty()) return "";
        const View view = explorer.view_after(explorer.place(edge.from), explorer.group_of(edge));
        const ImageSet images = explorer.images_of(edge);
        std::erase_if(open,
                      [&](std::size_t part) { return (images & images_where(*parts[part], view)).any(); });
    }
    if (open.empty()) return "";
    const bool by_assumption = !explorer.machine().permitted().all();
    return fmt::format("{} never holds by itself{}", part_in_words(property.text, open.front(), parts.size()),
                       by_assumption ? " under the assumptions" : "");
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
            if (std::string why = why_ruled_out(explorer.machine(), property); !why.empty()) return why;
            return property.form == Form::never ? part_that_never_holds(explorer, property) : "";
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
