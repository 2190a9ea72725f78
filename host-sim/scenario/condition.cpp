#include "sim/condition.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "set_points/values.h"

namespace nplc::sim {
namespace {

bool compare(const Condition& condition, double seen) {
    using Relation = Condition::Relation;
    switch (condition.relation) {
        case Relation::equal:
            return std::abs(seen - condition.operand) <= condition.tolerance;
        case Relation::unequal:
            return seen != condition.operand;
        case Relation::less:
            return seen < condition.operand;
        case Relation::at_most:
            return seen <= condition.operand;
        case Relation::more:
            return seen > condition.operand;
        case Relation::at_least:
            return seen >= condition.operand;
    }
    return false;
}

/// A copy of a step counts as that step, unless the condition names the copy.
double seen_value(const Condition& condition, const Snapshot& snapshot, const Names& names) {
    const double seen = condition.value.of(snapshot);
    if (condition.value.kind != Value::Kind::step || seen == condition.operand) return seen;
    const auto copy = names.copy_of.find(snapshot.step);
    return copy == names.copy_of.end() ? seen : copy->second;
}

/// At most four decimals.
std::string in_unit(double value, const Unit& unit) {
    std::string text = fmt::format("{:.4f}", value / unit.size);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return fmt::format("{}{}{}", text == "-0" ? "0" : text, unit.name.empty() ? "" : " ", unit.name);
}

/// `step = Fault`, `P_IST = 80.02 mm`.
std::string describe(const Condition& condition, const Snapshot& snapshot, const Names& names) {
    if (condition.value.kind == Value::Kind::step) return "step = " + names.step(snapshot.step);
    const double value = condition.value.of(snapshot);
    const unsigned index = condition.value.index;
    return fmt::format("{} = {}", condition.value.name(names),
                       condition.value.kind == Value::Kind::set_point
                           ? set_points::text_of(names.set_points.values[index], snapshot.set_points[index])
                           : in_unit(value, condition.unit));
}

void collect(const Condition& condition, const Snapshot& snapshot, const Names& names,
             std::vector<std::string>& texts) {
    std::string text;
    if (condition.kind == Condition::Kind::compare) text = describe(condition, snapshot, names);
    if (condition.kind == Condition::Kind::ordered) {
        for (const SentOrder& order : snapshot.orders)
            text += (text.empty() ? "" : ", ") + in_words(order, names.motor);
        text = text.empty() ? "nothing ordered" : "ordered " + text;
    }
    if (!text.empty() && std::find(texts.begin(), texts.end(), text) == texts.end()) texts.push_back(text);
    for (const Condition& part : condition.parts) collect(part, snapshot, names, texts);
}

}  // namespace

bool Value::is_bit() const {
    switch (kind) {
        case Kind::input:
        case Kind::output:
        case Kind::in_position:
        case Kind::error:
        case Kind::link:
        case Kind::running:
            return true;
        default:
            return false;
    }
}

double Value::of(const Snapshot& s) const {
    switch (kind) {
        case Kind::input:
            return (s.inputs >> index & 1) != (inverted ? 1 : 0) ? 1 : 0;
        case Kind::output:
            return s.outputs >> index & 1;
        case Kind::inputs:
            return s.inputs;
        case Kind::outputs:
            return s.outputs;
        case Kind::step:
            return s.step;
        case Kind::timer:
            return s.timer;
        case Kind::counter:
            return s.counter;
        case Kind::in_position:
            return s.in_position ? 1 : 0;
        case Kind::error:
            return s.error ? 1 : 0;
        case Kind::link:
            return s.link_up ? 1 : 0;
        case Kind::running:
            return s.running ? 1 : 0;
        case Kind::p_ist:
            return s.p_ist;
        case Kind::v_ist:
            return s.v_ist;
        case Kind::shaft:
            return static_cast<double>(s.shaft);
        case Kind::torque:
            return s.torque;
        case Kind::set_point:
            return s.set_points[index];
    }
    return 0;
}

std::string Value::name(const Names& names) const {
    switch (kind) {
        case Kind::input:
            return names.is_inverted(index) == inverted ? names.input(index) : fmt::format("IN{}", index);
        case Kind::output:
            return names.output(index);
        case Kind::inputs:
            return "INPUTS";
        case Kind::outputs:
            return "OUTPUTS";
        case Kind::step:
            return "step";
        case Kind::timer:
            return "TIMER";
        case Kind::counter:
            return "COUNTER";
        case Kind::in_position:
            return "INPOS";
        case Kind::error:
            return "ERROR";
        case Kind::link:
            return "LINK";
        case Kind::running:
            return "RUNNING";
        case Kind::p_ist:
            return "P_IST";
        case Kind::v_ist:
            return "V_IST";
        case Kind::shaft:
            return "SHAFT";
        case Kind::torque:
            return "TORQUE";
        case Kind::set_point:
            return names.set_points.values[index].name;
    }
    return "?";
}

bool Condition::holds(const Snapshot& snapshot, const Names& names) const {
    const auto part_holds = [&](const Condition& part) { return part.holds(snapshot, names); };
    switch (kind) {
        case Kind::compare:
            return compare(*this, seen_value(*this, snapshot, names));
        case Kind::ordered:
            return std::any_of(snapshot.orders.begin(), snapshot.orders.end(), [&](const SentOrder& given) {
                return normal_order(in_words(given, names.motor)) == order;
            });
        case Kind::negated:
            return !part_holds(parts.front());
        case Kind::both:
            return std::all_of(parts.begin(), parts.end(), part_holds);
        case Kind::either:
            return std::any_of(parts.begin(), parts.end(), part_holds);
    }
    return false;
}

std::string Condition::seen(const Snapshot& snapshot, const Names& names) const {
    std::vector<std::string> texts;
    collect(*this, snapshot, names, texts);
    return fmt::format("{}", fmt::join(texts, ", "));
}

bool EventWatch::happens(const Snapshot& snapshot, const Names& names) {
    const bool sets_in_now =
        sets_in(snapshot, names) && (!event_->guard || event_->guard->holds(snapshot, names));
    if (event_->span == Time{0}) return sets_in_now;
    if (sets_in_now) since_ = snapshot.time;
    if (!lasts(snapshot, names)) since_.reset();
    if (!since_ || snapshot.time < *due()) return false;
    since_.reset();
    return true;
}

std::optional<Time> EventWatch::due() const {
    if (!since_) return std::nullopt;
    return *since_ + event_->span;
}

bool EventWatch::lasts(const Snapshot& snapshot, const Names& names) const {
    const bool wanted = event_->edge != Event::Edge::falls;
    return event_->condition.holds(snapshot, names) == wanted &&
           (!event_->guard || event_->guard->holds(snapshot, names));
}

bool EventWatch::sets_in(const Snapshot& snapshot, const Names& names) {
    const bool by_value =
        event_->edge == Event::Edge::changes && event_->condition.kind == Condition::Kind::compare;
    const bool holds = !by_value && event_->condition.holds(snapshot, names);
    const double now = by_value ? event_->condition.value.of(snapshot) : (holds ? 1 : 0);
    const std::optional<double> before = std::exchange(before_, now);
    switch (event_->edge) {
        case Event::Edge::true_now:
            return holds && (!before || *before == 0);
        case Event::Edge::rises:
            return holds && before && *before == 0;
        case Event::Edge::falls:
            return !holds && before && *before != 0;
        case Event::Edge::changes:
            return before && *before != now;
        case Event::Edge::each:
            return holds;
    }
    return false;
}

std::string Condition::in_its_unit(double number) const {
    return in_unit(number, unit);
}

std::string normal_order(const std::string& words) {
    std::string text;
    for (const char c : lower(words)) {
        if (c != ' ' && c != '\t') text += c;
    }
    return text;
}

}  // namespace nplc::sim
