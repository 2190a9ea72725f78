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

constexpr unsigned kViews = 64 * 128;

View view_of(unsigned number) {
    return {.step = static_cast<std::uint8_t>(number % 64U),
            .outputs = static_cast<std::uint8_t>(number / 64U % 16U),
            .timer_zero = (number & 1024U) != 0,
            .counter_zero = (number & 2048U) != 0,
            .moving = (number & 4096U) != 0};
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

/// What could break a property, by the images of single scans: all that any machine could do in some steps.
class Breaking {
  public:
    explicit Breaking(const Property& property)
        : property_(property), at_power_up_(images_where(property.then, {})) {
        if (property.form == Form::changes_only_in) add_change(ImageSet{1}, {});
    }

    void add(const View& view, const ImageSet& permitted) {
        const auto where = [&](const Condition& condition) { return images_where(condition, view); };
        const ImageSet c = where(property_.condition) & permitted;
        switch (property_.form) {
            case Form::never:
                return add_scan(c);
            case Form::always:
            case Form::reachable:
            case Form::always_possible:
                return add_scan(~c & permitted);
            case Form::whenever:
            case Form::only_after:
                return add_scan(c & ~where(property_.then));
            case Form::never_while:
                return add_scan(c & where(property_.then));
            case Form::after_possible:
                return add_scan(~c & permitted & where(property_.then));
            case Form::stays:
                return add_scan(~where(property_.then) & ~where(property_.third) & permitted);
            case Form::followed_by:
                return add_scan(where(property_.then) & ~where(property_.third) & permitted);
            case Form::only_after_both:
                return add_scan(c);
            case Form::changes_only_in:
                return add_change(permitted, view);
            case Form::scan_ends:  // both conditions use the inputs of the same scan
                first_ |= c;
                second_ |= ~where(property_.then) & permitted;
                break;
            case Form::only_from:
                first_ |= c;
                second_ |= ~where(property_.then) & permitted;
                begins_without_ = begins_without_ || (permitted & ~at_power_up_).any();
                break;
        }
        if (begins_without_ || property_.form == Form::scan_ends)
            can_be_ = can_be_ || (first_ & second_).any();
    }

    bool can_be() const { return can_be_; }

  private:
    void add_scan(const ImageSet& images) { can_be_ = can_be_ || images.any(); }
    /// It differs between two scans in neither of which IN's condition holds.
    void add_change(const ImageSet& images, const View& view) {
        const ImageSet elsewhere = images & ~images_where(property_.then, view);
        const ImageSet c = images_where(property_.condition, view);
        first_ |= elsewhere & c;
        second_ |= elsewhere & ~c;
        can_be_ = can_be_ || (first_.any() && second_.any());
    }

    const Property& property_;
    ImageSet at_power_up_;
    ImageSet first_;
    ImageSet second_;
    bool begins_without_ = false;
    bool can_be_ = false;
};

bool is_always(bool value, const Condition& condition) {
    for (unsigned number = 0; number < kViews; ++number) {
        const ImageSet images = images_where(condition, view_of(number));
        if (value ? !images.all() : images.any()) return false;
    }
    return true;
}

/// The condition that is asked of what the property is about, and what it is called.
std::string what_always_holds(const Property& property) {
    const auto said = [](const Condition& condition, const char* name, bool value = true) {
        return is_always(value, condition)
                   ? fmt::format("{} condition always holds, whatever the machine does", name)
                   : "it holds whatever the machine does";
    };
    switch (property.form) {
        case Form::never:
            if (property.is_implied) return said(property.condition.operands.back(), "THEN's", false);
            return "its condition contradicts itself, and never holds whatever the machine does";
        case Form::always:
        case Form::reachable:
        case Form::always_possible:
            return "its condition always holds, whatever the machine does";
        case Form::whenever:
            return said(property.then, "THEN's");
        case Form::only_after:
            return said(property.then, "AFTER's");
        case Form::only_from:
            return "FROM's condition holds when the first scan begins, whatever the machine does";
        case Form::changes_only_in:
            return said(property.then, "IN's");
        case Form::scan_ends:
            return said(property.then, "ENDS IN's");
        case Form::followed_by:
            return said(property.third, "THEN's");
        case Form::stays:
            return said(property.third, "the STAYS");
        default:
            return "it holds whatever the machine does";
    }
}

/// Why nothing can break a property, whatever is in the table's steps; empty if something can.
std::string why_ruled_out(const Machine& machine, const Property& property) {
    const std::uint64_t steps = steps_of(machine);
    Breaking permitted(property);
    Breaking in_a_step(property);
    Breaking anywhere(property);
    for (unsigned number = 0; number < kViews; ++number) {
        const View view = view_of(number);
        anywhere.add(view, ~ImageSet{});
        if (((steps >> view.step) & 1U) == 0) continue;
        in_a_step.add(view, ~ImageSet{});
        permitted.add(view, machine.permitted());
        if (permitted.can_be()) return "";
    }
    if (in_a_step.can_be()) return "the assumptions about inputs alone rule it out";
    if (anywhere.can_be()) return "it asks for a step that the table does not have";
    return what_always_holds(property);
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
    const bool is_plain = property.form == Form::always || property.form == Form::reachable ||
                          property.form == Form::always_possible ||
                          (property.form == Form::never && !property.is_implied);
    const bool is_asked_of_scans = property.form == Form::never || property.form == Form::whenever ||
                                   property.form == Form::never_while ||
                                   property.form == Form::after_possible;
    if (is_asked_of_scans && !is_plain) {
        if (!is_met && explorer.complete()) return never_holds(property);
    } else if (!is_plain) {
        if (explorer.has_all_edges() && !breaking_course(explorer, unfulfilled(property)))
            return never_holds(property);
    }
    if (std::string why = why_ruled_out(explorer.machine(), property); !why.empty()) return why;
    return is_plain && property.form == Form::never ? part_that_never_holds(explorer, property) : "";
}

}  // namespace nplc::verify
