#include "set_point_request.h"

#include <fmt/format.h>

#include <algorithm>

#include "set_points/recipe_file.h"
#include "set_points/recipes.h"
#include "set_points/values.h"

namespace nplc::panel {
namespace {

using registers::gateway::SetPointRequest;
using set_points::NewValue;
using set_points::Recipe;
using set_points::RecipeFormat;
using set_points::SetPoint;
using Read = SetPointsRead;

Read refused(std::string why) {
    return {{}, true, std::move(why)};
}

Read no_message(std::string why) {
    return {{}, false, std::move(why)};
}

std::string names_of(const set_points::Record& record) {
    std::string names;
    for (const SetPoint& one : record.values) names += (names.empty() ? "" : ", ") + one.name;
    return names;
}

/// Text with or without a unit, or a number in the set-point's unit.
std::string text_of(const nlohmann::json& value) {
    if (value.is_string()) return value.get<std::string>();
    return value.is_number() ? value.dump() : std::string();
}

std::string action_of(const set_points::Record& record, const std::vector<NewValue>& values) {
    std::string text;
    for (const NewValue& value : values) {
        const SetPoint& point = record.values[value.index];
        text += fmt::format("{} {} := {}", text.empty() ? "set" : " and", point.name,
                            set_points::text_of(point, value.value));
    }
    return text;
}

/// All values that loading the recipe sets.
std::vector<NewValue> all_values(const Recipe& recipe, const set_points::Record& record) {
    std::vector<NewValue> all;
    for (std::size_t i = 0; i < record.values.size(); ++i) all.push_back({i, record.values[i].initial});
    for (const NewValue& value : recipe.values) all[value.index].value = value.value;
    return all;
}

std::optional<RecipeFormat> format_of(const Request& request) {
    const std::string format = request.text("format");
    if (format == "csv") return RecipeFormat::csv;
    if (format == "toml") return RecipeFormat::toml;
    return std::nullopt;
}

}  // namespace

SetPointsRead SetPointWork::read(const Request& request, const SetPointFeed& feed) {
    if (feed.record().values.empty())
        return refused("the active table has no set-points; declare them with SET_POINT and upload it");
    const auto crc = request.whole("crc");
    if (crc && *crc != feed.book().record_crc)
        return refused("another table is active by now, and its set-points are others; nothing was changed");
    if (request.what == "set_points") return change(request, feed);
    return request.text("action") == "import" ? import_from(request, feed) : one_recipe(request, feed);
}

SetPointsRead SetPointWork::change(const Request& request, const SetPointFeed& feed) {
    const set_points::Record& record = feed.record();
    const auto found = request.body.find("values");
    if (found == request.body.end() || !found->is_object() || found->empty())
        return no_message(R"("values" must be an object, such as {"Length": "80 mm"})");
    std::vector<NewValue> values;
    for (const auto& [name, text] : found->items()) {
        const SetPoint* point = set_points::find(record, name);
        if (point == nullptr)
            return refused(fmt::format("there is no set-point '{}'; there are {}; nothing was changed", name,
                                       names_of(record)));
        const set_points::Reading value = set_points::read_value(*point, text_of(text));
        if (!value.error.empty()) return refused(value.error + "; nothing was changed");
        const auto index = static_cast<std::size_t>(point - record.values.data());
        const bool is_twice =
            std::any_of(values.begin(), values.end(), [&](const NewValue& v) { return v.index == index; });
        if (is_twice) return refused(fmt::format("{} stands here twice; nothing was changed", point->name));
        values.push_back({index, value.value});
    }
    SetPointWork work(request, feed.book());
    work.action_ = action_of(record, values);
    work.requests_.push_back(set_points::encode_request(record, SetPointRequest::change, std::move(values)));
    return {std::move(work), true, {}};
}

SetPointsRead SetPointWork::one_recipe(const Request& request, const SetPointFeed& feed) {
    const std::string action = request.text("action");
    const std::string name = request.text("name");
    const bool saves = action == "save";
    if (!saves && action != "load" && action != "delete")
        return no_message(R"("action" must be save, load, delete, export or import)");
    const Recipe* recipe = set_points::find_recipe(feed.book().recipes, name);
    if (saves) {
        std::string problem = set_points::recipe_name_problem(name);
        if (!problem.empty()) return refused(std::move(problem));
    } else if (recipe == nullptr) {
        return refused(set_points::no_such_recipe(feed.book().recipes, name));
    }
    const SetPointRequest kind = saves              ? SetPointRequest::save_recipe
                                 : action == "load" ? SetPointRequest::load_recipe
                                                    : SetPointRequest::delete_recipe;
    SetPointWork work(request, feed.book());
    if (action == "load") work.action_ = action_of(feed.record(), all_values(*recipe, feed.record()));
    work.requests_.push_back(set_points::encode_request(feed.record(), kind, {}, {.name = name}));
    return {std::move(work), true, {}};
}

/// The whole file is checked before the first recipe is stored.
SetPointsRead SetPointWork::import_from(const Request& request, const SetPointFeed& feed) {
    const auto format = format_of(request);
    if (!format) return no_message(R"("format" must be csv or toml)");
    const set_points::RecipeReading file =
        set_points::read_recipes(request.text("text"), feed.record(), *format);
    if (!file.error.empty()) return refused(fmt::format("line {}; nothing was imported", file.error));
    const std::string problem =
        set_points::recipe_room_problem(feed.book().recipes, feed.room(), file.recipes);
    if (!problem.empty()) return refused(problem + "; nothing was imported");
    SetPointWork work(request, feed.book());
    for (const Recipe& recipe : file.recipes) {
        work.requests_.push_back(set_points::encode_request(feed.record(), SetPointRequest::put_recipe,
                                                            recipe.values, {.name = recipe.name}));
        work.names_.push_back(recipe.name);
    }
    return {std::move(work), true, {}};
}

SetPointsRead SetPointWork::export_to(const Request& request, const SetPointFeed& feed, std::string& file) {
    const auto format = format_of(request);
    if (!format) return no_message(R"("format" must be csv or toml)");
    if (feed.book().recipes.empty()) return refused("no recipe is saved");
    file = set_points::write_recipes(feed.book().recipes, feed.record(), *format);
    return {};
}

std::optional<faces::Command> SetPointWork::next(base::Instant now) {
    if (is_over() || is_waiting_) return std::nullopt;
    is_waiting_ = true;
    return faces::Command::set_points(requests_[done_], registers::gateway::Origin::panel, now);
}

void SetPointWork::ended(const faces::Completion& completion) {
    is_waiting_ = false;
    result_ = completion.result;
    detail_ = completion.detail;
    if (result_ == faces::Result::done) ++done_;
}

std::string SetPointWork::text() const {
    const bool imports = !names_.empty();
    std::string why = result_ == faces::Result::done
                          ? ""
                          : faces::describe_refusal(book_, {.id = 0, .result = result_, .detail = detail_});
    if (!imports) return why;
    const std::string done = fmt::format("{} recipe{} stored", done_, done_ == 1 ? "" : "s");
    return why.empty() ? done : fmt::format("'{}': {}; {} before it", names_[done_], why, done);
}

}  // namespace nplc::panel
