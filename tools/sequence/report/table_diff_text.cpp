#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "report/table_diff.h"
#include "report/table_text.h"

namespace nplc::seqc {
namespace {

using Json = nlohmann::ordered_json;
using Step = TableDiff::Step;
using Value = TableDiff::Value;
using Change = TableDiff::Change;

std::string line_of(const Step& step) {
    switch (step.kind) {
        case Step::Kind::added:
            return fmt::format("{} is new, step {}\n", step.now, step.number_now);
        case Step::Kind::removed:
            return fmt::format("{} is gone, it was step {}\n", step.before, step.number_before);
        case Step::Kind::renamed:
            return fmt::format("{} is called {} now\n", step.before, step.now);
        case Step::Kind::renumbered:
            break;
    }
    return {};
}

std::string renumbered(const std::vector<Step>& steps) {
    std::string list;
    for (const Step& step : steps) {
        const bool moved = step.number_before != step.number_now;
        if (moved && step.kind != Step::Kind::added && step.kind != Step::Kind::removed)
            append(list, fmt::format("{} {} -> {}", step.now, step.number_before, step.number_now), ", ");
    }
    return list.empty() ? list : "other step numbers, which change nothing: " + list + "\n";
}

std::string line_of(const Value& value) {
    if (!value.before || !value.now) {
        const std::string& units = value.now ? value.now_in_units : value.before_in_units;
        return fmt::format("{}: {}{}{}\n", value.name,
                           value.now ? "written now: " : "no longer written; it was ",
                           value.now ? *value.now : *value.before, units.empty() ? "" : " (" + units + ")");
    }
    const bool units = !value.before_in_units.empty() && !value.now_in_units.empty();
    return fmt::format("{}: {} -> {}{}\n", value.name, *value.before, *value.now,
                       units ? fmt::format(" ({} -> {})", value.before_in_units, value.now_in_units) : "");
}

std::string line_of(const Change& change) {
    return fmt::format("{}{}: {}; before: {}\n", change.step,
                       change.when.empty() ? "" : ", when " + change.when,
                       change.now == "nothing" ? "does nothing" : change.now, change.before);
}

std::string line_of(const SetPointChange& change) {
    if (change.before.empty()) return fmt::format("set-point {} is new: {}\n", change.name, change.now);
    if (change.now.empty())
        return fmt::format("set-point {} is gone, it was {}\n", change.name, change.before);
    return fmt::format("set-point {}: {} -> {}\n", change.name, change.before, change.now);
}

std::string takers(const std::vector<std::string>& steps, std::string_view how) {
    if (steps.empty()) return {};
    return fmt::format("{}: take{} set-points {}\n", fmt::join(steps, ", "), steps.size() == 1 ? "s" : "",
                       how);
}

template <class List>
std::string lines_of(const List& list) {
    std::string text;
    for (const auto& item : list) text += line_of(item);
    return text;
}

std::string_view name_of(Step::Kind kind) {
    switch (kind) {
        case Step::Kind::added:
            return "added";
        case Step::Kind::removed:
            return "removed";
        case Step::Kind::renamed:
            return "renamed";
        case Step::Kind::renumbered:
            break;
    }
    return "renumbered";
}

Json json_of(const Step& step) {
    Json json{{"kind", name_of(step.kind)}};
    if (step.kind != Step::Kind::added) {
        json["before"] = step.before;
        json["number_before"] = step.number_before;
    }
    if (step.kind != Step::Kind::removed) {
        json["now"] = step.now;
        json["number_now"] = step.number_now;
    }
    return json;
}

Json json_of(const Value& value) {
    Json json{{"register", value.reg}, {"name", value.name}};
    if (value.before) json["before"] = *value.before;
    if (value.now) json["now"] = *value.now;
    if (!value.before_in_units.empty()) json["before_in_units"] = value.before_in_units;
    if (!value.now_in_units.empty()) json["now_in_units"] = value.now_in_units;
    return json;
}

Json json_of(const Change& change) {
    return {{"step", change.step}, {"when", change.when}, {"now", change.now}, {"before", change.before}};
}

Json json_of(const SetPointChange& change) {
    return {{"name", change.name}, {"now", change.now}, {"before", change.before}};
}

template <class List>
Json array_of(const List& list) {
    Json array = Json::array();
    for (const auto& item : list) array.push_back(json_of(item));
    return array;
}

}  // namespace

std::string text_of(const TableDiff& diff) {
    std::string motor;
    if (!diff.motor_now.empty())
        motor = fmt::format("for another motor: {} -> {}\n", diff.motor_before, diff.motor_now);
    const std::string names = lines_of(diff.steps) + renumbered(diff.steps);
    const std::string set_points =
        lines_of(diff.set_points) + takers(diff.take_now, "now") + takers(diff.take_no_more, "no more");
    if (diff.same_bytes) return "the same bytes\n" + motor + names + set_points;
    if (diff.same_behaviour()) return "other bytes, but every step does the same\n" + motor + names;
    return motor + names + lines_of(diff.values) + lines_of(diff.outputs) + lines_of(diff.entries) +
           lines_of(diff.reactions) + set_points;
}

std::string json_of(const TableDiff& diff) {
    const Json json{{"same_bytes", diff.same_bytes},         {"same_behaviour", diff.same_behaviour()},
                    {"motor_before", diff.motor_before},     {"motor_now", diff.motor_now},
                    {"steps", array_of(diff.steps)},         {"values", array_of(diff.values)},
                    {"outputs", array_of(diff.outputs)},     {"entries", array_of(diff.entries)},
                    {"reactions", array_of(diff.reactions)}, {"set_points", array_of(diff.set_points)},
                    {"take_set_points_now", diff.take_now},  {"take_set_points_no_more", diff.take_no_more}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace nplc::seqc
