#include "parser.h"
#include "units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace nplc::sim {
namespace {

using Relation = Condition::Relation;

/// Conditions are parsed, evaluated and destroyed recursively.
constexpr int kDeepest = 100;

constexpr std::array<std::pair<std::string_view, Relation>, 6> kRelations{{{"=", Relation::equal},
                                                                           {"<>", Relation::unequal},
                                                                           {"<", Relation::less},
                                                                           {"<=", Relation::at_most},
                                                                           {">", Relation::more},
                                                                           {">=", Relation::at_least}}};

constexpr std::array<std::pair<std::string_view, Value::Kind>, 14> kValues{{
    {"INPUTS", Value::Kind::inputs},
    {"OUTPUTS", Value::Kind::outputs},
    {"STEP", Value::Kind::step},
    {"TIMER", Value::Kind::timer},
    {"COUNTER", Value::Kind::counter},
    {"INPOS", Value::Kind::in_position},
    {"IN_POS", Value::Kind::in_position},
    {"ERROR", Value::Kind::error},
    {"LINK", Value::Kind::link},
    {"RUNNING", Value::Kind::running},
    {"P_IST", Value::Kind::p_ist},
    {"V_IST", Value::Kind::v_ist},
    {"SHAFT", Value::Kind::shaft},
    {"TORQUE", Value::Kind::torque},
}};

/// `IN3` with prefix IN and 6 signals: 3.
std::optional<unsigned> numbered(std::string_view word, std::string_view prefix, unsigned count) {
    if (word.size() != prefix.size() + 1 || !same_name(word.substr(0, prefix.size()), prefix))
        return std::nullopt;
    const auto index = parse_integer(word.substr(prefix.size()));
    if (!index || *index < 0 || *index >= count) return std::nullopt;
    return static_cast<unsigned>(*index);
}

template <std::size_t Count>
std::optional<unsigned> named(std::string_view word, const std::array<std::string, Count>& names) {
    for (unsigned i = 0; i < Count; ++i) {
        if (!names[i].empty() && same_name(names[i], word)) return i;
    }
    return std::nullopt;
}

template <std::size_t Count>
void append(std::string& list, const std::array<std::string, Count>& names) {
    for (const std::string& name : names) {
        if (!name.empty()) list += name + ", ";
    }
}

}  // namespace

Condition ConditionParser::either() {
    Condition first = both();
    if (!reader_.is("or")) return first;
    Condition all{.kind = Condition::Kind::either, .value = {}, .order = {}, .parts = {std::move(first)}};
    while (reader_.take("or")) all.parts.push_back(both());
    return all;
}

Condition ConditionParser::both() {
    Condition first = primary();
    if (!reader_.is("and")) return first;
    Condition all{.kind = Condition::Kind::both, .value = {}, .order = {}, .parts = {std::move(first)}};
    while (reader_.take("and")) all.parts.push_back(primary());
    return all;
}

Condition ConditionParser::primary() {
    if (reader_.take("not")) {
        return {.kind = Condition::Kind::negated,
                .value = {},
                .order = {},
                .parts = {nested(&ConditionParser::primary)}};
    }
    if (reader_.take("(")) {
        Condition inner = nested(&ConditionParser::either);
        reader_.want(")", ") to close the parenthesis");
        return inner;
    }
    const bool has_order = reader_.peek(1).kind == Token::Kind::text || !knows("ordered");
    if (has_order && reader_.take("ordered")) return order();
    return comparison();
}

Condition ConditionParser::nested(Condition (ConditionParser::*part)()) {
    if (++depth_ > kDeepest) {
        reader_.refuse(fmt::format(
            "parentheses and NOTs are more than {} deep; write the condition in a simpler way", kDeepest));
    }
    Condition inner = (this->*part)();
    --depth_;
    return inner;
}

Condition ConditionParser::order() {
    if (reader_.peek().kind != Token::Kind::text) {
        reader_.fail("the order in quotes, such as ordered \"POSITION(P2)\" or ordered \"V1 := 3146\"");
    }
    const std::size_t mark = reader_.mark();
    OrderReading read = read_order(reader_.next().text, names_);
    if (!read.mistake.empty()) reader_.refuse_at(mark, read.mistake);
    return {.kind = Condition::Kind::ordered, .value = {}, .order = std::move(read.order), .parts = {}};
}

Condition ConditionParser::comparison() {
    Condition result{.value = value(), .order = {}, .parts = {}};
    if (result.value.kind == Value::Kind::step && reader_.take("in")) return group();
    for (const auto& [symbol, relation] : kRelations) {
        if (!reader_.take(symbol)) continue;
        result.relation = relation;
        operand(result);
        return result;
    }
    if (!result.value.is_bit() && !reader_.is("changes")) {
        reader_.fail(fmt::format("a comparison, such as {} = 0", result.value.name(names_)));
    }
    return result;
}

void ConditionParser::operand(Condition& condition) {
    const bool by_size = condition.relation != Relation::equal && condition.relation != Relation::unequal;
    if (condition.value.is_bit()) {
        if (by_size) reader_.refuse("a signal is 0 or 1; compare it with = or <>");
        condition.operand = level() ? 1 : 0;
    } else if (condition.value.kind == Value::Kind::step) {
        condition.operand = step_number();
    } else {
        quantity(condition);
    }
}

void ConditionParser::quantity(Condition& condition) {
    const Value::Kind kind = condition.value.kind;
    if (kind == Value::Kind::set_point) return set_point_value(condition);
    if (kind == Value::Kind::timer && reader_.starts_duration()) {
        condition.operand = static_cast<double>(reader_.duration("a time").count()) / 1e6;
        condition.unit = {"ms", 1};
        return;
    }
    const Measure wanted = measure("a number", kind);
    condition.operand = wanted.value;
    condition.unit = wanted.unit;
    if (!reader_.take("+-")) return want_unit(kind, wanted);
    if (condition.relation != Relation::equal) reader_.refuse("a tolerance (+-) goes with = only");
    const Measure tolerance = measure("a number after +-", kind);
    condition.tolerance = tolerance.value;
    if (tolerance.value < 0) reader_.refuse("a tolerance is not negative; write it without the sign");
    if (wanted.unit.name.empty()) {
        if (tolerance.unit.name.empty()) want_unit(kind, wanted);
        condition.unit = tolerance.unit;
    } else if (tolerance.unit.name.empty()) {
        reader_.refuse(fmt::format("the tolerance has no unit; write {} behind it, or {}", wanted.unit.name,
                                   units_in_words(kind, names_)));
    }
}

void ConditionParser::want_unit(Value::Kind kind, const Measure& measure) const {
    if (!names_.machine || measure.value == 0 || !measure.unit.name.empty() || kind == Value::Kind::torque ||
        units_of(kind, names_).empty())
        return;
    reader_.refuse(fmt::format("{:.6g} of what? The program has a SCALE; write {} behind it", measure.value,
                               units_in_words(kind, names_)));
}

ConditionParser::Measure ConditionParser::measure(std::string_view what, Value::Kind kind) {
    const double number = reader_.number(what);
    for (const Unit& unit : units_of(kind, names_)) {
        if (take_unit(unit.name)) return {number * unit.size, unit};
    }
    if (at_other_unit()) refuse_unit(number, kind);
    return {number, {}};
}

bool ConditionParser::at_other_unit() const {
    const Token& next = reader_.peek();
    if (reader_.is("%")) return true;
    return next.kind == Token::Kind::word && !knows(next.text) && !reader_.is(":=", 1) &&
           is_meant_as_unit(next.text, names_);
}

/// `%peak` is two tokens.
bool ConditionParser::has_share() const {
    return reader_.is("%") && reader_.peek(1).kind == Token::Kind::word &&
           reader_.peek(1).begin == reader_.peek().end;
}

/// The word behind a number, `mm`, `mm/s` or `%peak`.
std::string ConditionParser::written_unit() const {
    if (has_share()) return fmt::format("%{}", reader_.peek(1).text);
    const bool is_rate = reader_.is("/", 1) && reader_.peek(2).kind == Token::Kind::word;
    return is_rate ? fmt::format("{}/{}", reader_.peek().text, reader_.peek(2).text)
                   : std::string(reader_.peek().text);
}

/// `mm`, `mm/s` with or without blanks, or `%peak`.
bool ConditionParser::take_unit(std::string_view name) {
    if (has_share()) {
        if (!same_name(written_unit(), name)) return false;
        reader_.next();
        reader_.next();
        return true;
    }
    const auto slash = name.find('/');
    if (!reader_.is(name.substr(0, slash))) return false;
    const bool has_slash = reader_.is("/", 1);
    if (has_slash != (slash != std::string_view::npos)) return false;
    if (has_slash && !reader_.is(name.substr(slash + 1), 2)) return false;
    for (int tokens = has_slash ? 3 : 1; tokens > 0; --tokens) reader_.next();
    return true;
}

void ConditionParser::refuse_unit(double number, Value::Kind kind) {
    const std::string unit = written_unit();
    const Value value{.kind = kind};
    const std::string name = value.name(names_);
    const std::string known = kind == Value::Kind::timer ? "ms or s" : units_in_words(kind, names_);
    if (known.empty()) reader_.refuse_next(fmt::format("{} has no unit; write the number alone", name));
    const bool could_scale = kind != Value::Kind::torque && kind != Value::Kind::timer && !names_.machine;
    reader_.refuse_next(fmt::format("\"{}\" is no unit of {}; write {}{}{}", unit, name, known,
                                    unit_hint(number, unit, units_of(kind, names_), value, names_),
                                    could_scale ? "; SCALE 1 rev = 5 mm; in the program adds mm" : ""));
}

double ConditionParser::length() {
    for (const Unit& unit : units_of(Value::Kind::shaft, names_)) {
        if (unit.name != "counts" && take_unit(unit.name)) return unit.size;
    }
    reader_.fail(names_.machine ? "per rev or per " + names_.machine->name
                                : "per rev, such as spring 2000 per rev");
}

std::int64_t ConditionParser::place() {
    constexpr double kFarthest = 1e9;
    const Measure place = measure("a place, such as -2 rev or 500 counts", Value::Kind::shaft);
    want_unit(Value::Kind::shaft, place);
    const double counts = place.value;
    if (counts < -kFarthest || counts > kFarthest) {
        reader_.refuse("a place is at most 1000000000 counts away; write a nearer one");
    }
    return std::llround(counts);
}

/// `step in Moving`
Condition ConditionParser::group() {
    Condition any{.kind = Condition::Kind::either, .value = {}, .order = {}, .parts = {}};
    const auto add = [&](double step) {
        any.parts.push_back(
            {.value = {.kind = Value::Kind::step}, .operand = step, .order = {}, .parts = {}});
    };
    const Token& token = reader_.peek();
    std::string known;
    for (const auto& [name, steps] : names_.groups) {
        known += (known.empty() ? "" : ", ") + name;
        if (token.kind != Token::Kind::word || !same_name(name, token.text)) continue;
        reader_.next();
        for (const std::uint8_t step : steps) add(step);
        return any;
    }
    const bool is_step = std::any_of(names_.steps.begin(), names_.steps.end(), [&](const auto& step) {
        return token.kind == Token::Kind::word && same_name(step.second, token.text);
    });
    if (!is_step && token.kind == Token::Kind::word) {
        reader_.refuse_next(fmt::format(
            "the program has no GROUP \"{}\"; write {}", token.text,
            known.empty() ? "GROUP Name: steps; in it, or step = Name" : fmt::format("one of {}", known)));
    }
    if (!is_step) reader_.fail("a group's name");
    add(step_number());
    return any;
}

double ConditionParser::step_number() {
    const Token& token = reader_.peek();
    for (const auto& [name, steps] : names_.groups) {
        if (token.kind == Token::Kind::word && same_name(name, token.text))
            reader_.refuse_next(fmt::format("{} is a group of steps; write step in {}", name, name));
    }
    if (token.kind == Token::Kind::number) {
        const double number = reader_.next().number;
        if (number != static_cast<int>(number) || number > 62)
            reader_.refuse("a step is a whole number 0 to 62");
        check_step(static_cast<unsigned>(number));
        return number;
    }
    std::string known;
    for (const auto& [number, name] : names_.steps) {
        if (token.kind == Token::Kind::word && same_name(name, token.text)) {
            reader_.next();
            return number;
        }
        known += (known.empty() ? "" : ", ") + name;
    }
    if (token.kind != Token::Kind::word) reader_.fail("a step's name or number");
    if (known.empty()) {
        reader_.refuse_next(
            fmt::format("\"{}\": this program has no step names; write the step's number", token.text));
    }
    reader_.refuse_next(fmt::format("the program has no step \"{}\"; write one of {}", token.text, known));
}

void ConditionParser::check_step(unsigned number) const {
    if (names_.numbers == 0 || (names_.numbers >> number & 1U) != 0) return;
    std::string known;
    for (unsigned step = 0; step < 64; ++step) {
        if ((names_.numbers >> step & 1U) == 0) continue;
        const unsigned first = step;
        while (step < 63 && (names_.numbers >> (step + 1) & 1U) != 0) ++step;
        known += fmt::format("{}{}", known.empty() ? "" : ", ", first);
        if (step != first) known += fmt::format("..{}", step);
    }
    reader_.refuse(fmt::format("the table has no step {}; it has {}", number, known));
}

bool ConditionParser::level() {
    const Token& token = reader_.peek();
    const bool is_number = token.kind == Token::Kind::number && (token.number == 0 || token.number == 1);
    if (is_number) return reader_.next().number == 1;
    if (reader_.take("true") || reader_.take("on")) return true;
    if (reader_.take("false") || reader_.take("off")) return false;
    reader_.fail("0 or 1");
}

std::optional<Value> ConditionParser::lookup(std::string_view word) const {
    if (same_name(word, "step")) return Value{.kind = Value::Kind::step};
    if (const auto index = named(word, names_.inputs))
        return Value{.kind = Value::Kind::input, .index = *index, .inverted = names_.is_inverted(*index)};
    if (const auto index = named(word, names_.outputs))
        return Value{.kind = Value::Kind::output, .index = *index};
    if (const auto index = numbered(word, "IN", kInputs))
        return Value{.kind = Value::Kind::input, .index = *index};
    if (const auto index = numbered(word, "OUT", kOutputs))
        return Value{.kind = Value::Kind::output, .index = *index};
    const std::vector<set_points::SetPoint>& points = names_.set_points.values;
    for (unsigned i = 0; i < points.size(); ++i) {
        if (same_name(points[i].name, word)) return Value{.kind = Value::Kind::set_point, .index = i};
    }
    for (const auto& [name, kind] : kValues) {
        if (same_name(name, word)) return Value{.kind = kind};
    }
    return std::nullopt;
}

std::string ConditionParser::known_values() const {
    std::string known;
    append(known, names_.inputs);
    append(known, names_.outputs);
    for (const set_points::SetPoint& point : names_.set_points.values) known += point.name + ", ";
    return known +
           "IN0..IN5, OUT0..OUT3, INPUTS, OUTPUTS, step, TIMER, COUNTER, INPOS, ERROR, LINK, RUNNING, P_IST, "
           "V_IST, SHAFT, TORQUE or ordered \"...\"";
}

Value ConditionParser::value() {
    if (reader_.peek().kind != Token::Kind::word)
        reader_.fail("a condition, such as IN0, NOT OUT1 or step = 3");
    const std::string_view word = reader_.peek().text;
    const auto found = lookup(word);
    if (!found)
        reader_.refuse_next(fmt::format("\"{}\" is not known; write one of {}", word, known_values()));
    const bool is_motors = found->kind == Value::Kind::p_ist || found->kind == Value::Kind::v_ist ||
                           found->kind == Value::Kind::shaft || found->kind == Value::Kind::torque;
    if (names_.motor_alone && !is_motors)
        reader_.refuse_next("here is the motor alone; write P_IST, V_IST, SHAFT or TORQUE");
    reader_.next();
    return *found;
}

Event ConditionParser::event() {
    const std::size_t begin = reader_.mark();
    Event event{.condition = condition(), .text = {}};
    edge(event);
    if (event.edge != Event::Edge::true_now && reader_.take("and")) event.guard = both();
    const std::size_t before = reader_.mark();
    event.span = reader_.lasting();
    const bool is_moment = event.edge == Event::Edge::each || event.edge == Event::Edge::changes;
    if (is_moment && reader_.mark() != before)
        reader_.refuse("a change or an order is a moment and does not last; remove for and its time");
    event.text = reader_.source_since(begin);
    return event;
}

void ConditionParser::edge(Event& event) {
    const bool is_order = event.condition.kind == Condition::Kind::ordered;
    if (reader_.take("rises")) {
        event.edge = Event::Edge::rises;
    } else if (reader_.take("falls")) {
        event.edge = Event::Edge::falls;
    } else if (reader_.take("changes")) {
        event.edge = Event::Edge::changes;
    }
    if (is_order && event.edge != Event::Edge::true_now)
        reader_.refuse("an order is a moment, it does not rise, fall or change; remove the word behind it");
    if (is_order) event.edge = Event::Edge::each;
}

Terminal ConditionParser::input(std::string_view use) {
    if (reader_.peek().kind != Token::Kind::word) reader_.fail(use);
    const std::string_view word = reader_.peek().text;
    const auto found = lookup(word);
    if (found && found->kind == Value::Kind::output) {
        reader_.refuse_next(fmt::format(
            "{} is an output: the sequence sets it, a scenario can only watch it; name an input", word));
    }
    if (found && found->kind == Value::Kind::set_point)
        reader_.refuse_next(fmt::format("{0} is a set-point; write set {0} := and its value", word));
    if (!found || found->kind != Value::Kind::input) {
        std::string known;
        append(known, names_.inputs);
        reader_.refuse_next(fmt::format("\"{}\" is no input; write one of {}IN0..IN5", word, known));
    }
    reader_.next();
    return {found->index, found->inverted};
}

Value ConditionParser::signal(std::string_view use) {
    const std::string_view word = reader_.peek().text;
    const auto found = lookup(word);
    if (!found || found->kind != Value::Kind::output) {
        const Terminal terminal = input(use);
        return {.kind = Value::Kind::input, .index = terminal.index, .inverted = terminal.inverted};
    }
    reader_.next();
    return *found;
}

}  // namespace nplc::sim
