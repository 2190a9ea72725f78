// set Length := 60 mm and Dwell := 800 ms; recipe save "Short"; recipe load "Short"; expect Length = 60 mm
#include <fmt/format.h>

#include <algorithm>

#include "parser.h"
#include "set_points/recipes.h"
#include "set_points/request.h"
#include "set_points/values.h"
#include "units.h"

namespace nplc::sim {

using registers::gateway::SetPointRequest;
using set_points::NewValue;

namespace {

constexpr double kRounded = 0.5;  // a value in whole steps is so far from the one that was written

}  // namespace

void SetPointParser::needs_set_points() const {
    if (conditions_.names().set_points.values.empty())
        reader_.refuse_next("the program has no set-points; declare one with SET_POINT");
}

/// The compiler leaves out what nothing uses.
std::string SetPointParser::no_such_point(std::string_view name) const {
    std::string known;
    for (const set_points::SetPoint& point : conditions_.names().set_points.values)
        known += (known.empty() ? "" : ", ") + point.name;
    return fmt::format(
        "the table has no set-point \"{}\": the program declares none, or uses it nowhere (W025); write {}{}",
        name, conditions_.names().set_points.values.size() == 1 ? "" : "one of ", known);
}

action::SetPoints SetPointParser::set() {
    needs_set_points();
    const std::size_t begin = reader_.mark();
    reader_.next();
    const set_points::Record& record = conditions_.names().set_points;
    std::vector<NewValue> values;
    do {
        const set_points::SetPoint* point = set_points::find(record, reader_.peek().text);
        if (reader_.peek().kind != Token::Kind::word)
            reader_.fail("a set-point of the program, such as set Length := 60 mm");
        if (point == nullptr) reader_.refuse_next(no_such_point(reader_.peek().text));
        reader_.next();
        reader_.want(":=", ":= and the value, such as set Length := 60 mm");
        const std::size_t mark = reader_.mark();
        while (!reader_.at_end() && !reader_.is(",") && !reader_.is("and")) reader_.next();
        const set_points::Reading read = set_points::read_value(*point, reader_.source_since(mark));
        if (!read.error.empty()) reader_.refuse_at(mark, read.error);
        const auto index = static_cast<std::size_t>(point - record.values.data());
        const auto same = [&](const NewValue& value) { return value.index == index; };
        if (std::any_of(values.begin(), values.end(), same))
            reader_.refuse_at(mark, fmt::format("{} is set twice in one change", point->name));
        values.push_back({index, read.value});
    } while (reader_.take("and"));
    return {set_points::encode_request(record, SetPointRequest::change, values), reader_.source_since(begin)};
}

/// Length = 90 mm, Length = 90 mm +- 1 mm, Dwell < 2 s: without a unit in its own.
void ConditionParser::set_point_value(Condition& condition) {
    const set_points::SetPoint& point = names_.set_points.values[condition.value.index];
    const std::size_t begin = reader_.mark();
    const Measure wanted = point_measure(point, "a number");
    condition.operand = wanted.value;
    condition.unit = wanted.unit;
    if (reader_.take("+-")) {
        if (condition.relation != Condition::Relation::equal)
            reader_.refuse("a tolerance (+-) goes with = only");
        condition.tolerance = point_measure(point, "a number after +-").value;
        if (condition.tolerance < 0) reader_.refuse("a tolerance is not negative; write it without the sign");
        condition.tolerance += kRounded;
        return;
    }
    if (condition.relation != Condition::Relation::equal &&
        condition.relation != Condition::Relation::unequal)
        return;
    const set_points::Reading exact = set_points::read_value(point, reader_.source_since(begin));
    if (!exact.error.empty()) reader_.refuse_at(begin, exact.error);
    condition.operand = exact.value;
}

ConditionParser::Measure ConditionParser::point_measure(const set_points::SetPoint& point,
                                                        std::string_view what) {
    const double number = reader_.number(what);
    const std::vector<Unit> units = units_of(point);
    for (const Unit& unit : units) {
        if (take_unit(unit.name)) return {number * unit.size, unit};
    }
    if (at_other_unit()) {
        if (units.empty())
            reader_.refuse_next(fmt::format("{} has no unit; write the number alone", point.name));
        const std::string unit = written_unit();
        reader_.refuse_next(
            fmt::format("\"{}\" is no unit of {}; write {}{}", unit, point.name,
                        units.size() > 1 ? "ms or s" : point.unit,
                        unit_hint(number, unit, units, Value{.kind = Value::Kind::set_point}, names_)));
    }
    return {number * point.steps_per_unit, {point.unit, point.steps_per_unit}};
}

/// By name. A scenario begins without recipes, so it can only load those it has saved.
action::SetPoints SetPointParser::recipe() {
    needs_set_points();
    const std::size_t begin = reader_.mark();
    reader_.next();
    const bool saves = reader_.take("save");
    if (!saves) reader_.want("load", "save or load and the recipe's name, such as recipe load \"Short\"");
    if (reader_.peek().kind != Token::Kind::text || reader_.peek().text.empty() ||
        reader_.peek().text.size() > set_points::kLongestRecipeName)
        reader_.fail("the recipe's name in quotes, up to 15 characters, such as recipe load \"Short\"");
    const std::string name(reader_.next().text);
    if (std::string problem = set_points::recipe_name_problem(name); !problem.empty())
        reader_.refuse(problem);
    const bool is_known = std::any_of(recipes_.begin(), recipes_.end(), [&](const std::string& recipe) {
        return set_points::is_same_recipe(recipe, name);
    });
    if (!is_known && !saves) reader_.refuse(fmt::format("no line above saves the recipe \"{}\"", name));
    if (!is_known) recipes_.push_back(name);
    return {set_points::encode_request(conditions_.names().set_points,
                                       saves ? SetPointRequest::save_recipe : SetPointRequest::load_recipe,
                                       {}, {.name = name}),
            reader_.source_since(begin)};
}

}  // namespace nplc::sim
