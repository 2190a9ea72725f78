#include "nanoctl/set_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/dropped.h"
#include "cli/session.h"
#include "command_line/files.h"
#include "set_points/recipe_file.h"
#include "set_points/recipes.h"
#include "set_points/values.h"
#include "whole_files/whole_files.h"

namespace nplc::nanoctl::cli {
namespace {

using gw::SetPointRequest;
using set_points::NewValue;
using set_points::Recipe;

Json point_json(const set_points::SetPoint& point, const KeptSetPoints& kept, std::size_t index) {
    const auto number = [&](std::int32_t value) { return set_points::shown_value(point, value); };
    return {{"name", point.name},
            {"value", number(kept.wanted[index])},
            {"in_force", number(kept.in_force[index])},
            {"unit", point.unit},
            {"lowest", number(point.lowest)},
            {"highest", number(point.highest)},
            {"step", point.step},
            {"initial", number(point.initial)}};
}

std::uint32_t active_recipe(const KeptSetPoints& kept) {
    return (kept.state & gw::kActiveRecipe) >> 8;
}

/// Empty: none is active.
std::string active_recipe_name(Session& session, const KeptSetPoints& kept) {
    if (active_recipe(kept) == 0) return {};
    for (const Recipe& recipe : read_recipes(session.gateway(), kept))
        if (recipe.number == active_recipe(kept)) return recipe.name;
    return {};
}

std::string state_text(const KeptSetPoints& kept, const std::string& recipe) {
    std::string text;
    if ((kept.state & gw::kChangeWaits) != 0)
        text +=
            "\nchanged values wait until the sequence takes them: at POWER_UP, a step that TAKES SET_POINTS, "
            "or a stop";
    if ((kept.state & gw::kValuesDamaged) != 0)
        text += "\nthe stored values are damaged: older ones or the defaults stand in; set them anew";
    if (!recipe.empty())
        text += fmt::format("\nrecipe '{}'{}", recipe,
                            (kept.state & gw::kRecipeDiffers) != 0 ? ", changed since it was loaded" : "");
    return text;
}

/// `dropped`: of what was loaded before.
void tell_set_points(Session& session, const KeptSetPoints& kept,
                     const std::vector<set_points::Dropped>& dropped) {
    std::string text;
    Json all = Json::array();
    for (std::size_t i = 0; i < kept.record.values.size(); ++i) {
        const set_points::SetPoint& point = kept.record.values[i];
        const std::string force =
            kept.in_force[i] == kept.wanted[i]
                ? ""
                : fmt::format(", in force {}", set_points::text_of(point, kept.in_force[i]));
        text += fmt::format("{}{:<18} {:<12} {}{}", text.empty() ? "" : "\n", point.name,
                            set_points::text_of(point, kept.wanted[i]), set_points::range_text(point), force);
        all.push_back(point_json(point, kept, i));
    }
    const std::string recipe_name = active_recipe_name(session, kept);
    session.tell(text + state_text(kept, recipe_name) + lines_of(dropped),
                 {{"set_points", all},
                  {"waits", (kept.state & gw::kChangeWaits) != 0},
                  {"damaged", (kept.state & gw::kValuesDamaged) != 0},
                  {"recipe", active_recipe(kept)},
                  {"recipe_name", recipe_name},
                  {"differs", (kept.state & gw::kRecipeDiffers) != 0},
                  {"dropped", json_of(dropped)}});
}

void show_set_points(Session& session) {
    tell_set_points(session, read_set_points(session.gateway()), {});
}

NewValue parse_value(const std::string& text, const set_points::Record& record) {
    const auto equals = text.find('=');
    if (equals == text.npos) throw UserError(fmt::format("'{}': write NAME=VALUE, as in Length=80mm", text));
    const std::string name = text.substr(0, equals);
    const set_points::SetPoint* point = set_points::find(record, name);
    if (point == nullptr) {
        std::string names;
        for (const set_points::SetPoint& one : record.values) names += (names.empty() ? "" : ", ") + one.name;
        throw UserError(
            fmt::format("the table has no set-point '{}'; it has {} (one that no step uses is left "
                        "out)",
                        name, names));
    }
    const set_points::Reading value = set_points::read_value(*point, text.substr(equals + 1));
    if (!value.error.empty()) throw UserError(fmt::format("{}; nothing was changed", value.error));
    return {static_cast<std::size_t>(point - record.values.data()), value.value};
}

void set_some(Session& session, const std::vector<std::string>& texts) {
    const KeptSetPoints kept = read_set_points(session.gateway());
    std::vector<NewValue> values;
    for (const std::string& text : texts) {
        values.push_back(parse_value(text, kept.record));
        const auto same = [&](const NewValue& v) { return v.index == values.back().index; };
        if (std::count_if(values.begin(), values.end(), same) > 1)
            throw UserError(fmt::format("'{}': it is set twice here; nothing was changed", text));
    }
    write_set_points(session.gateway(), kept.record,
                     set_points::encode_request(kept.record, SetPointRequest::change, values));
    show_set_points(session);
}

void show_or_set(Session& session, const std::vector<std::string>& words) {
    if (words.empty()) return show_set_points(session);
    if (words.front() != "set" || words.size() == 1)
        throw UserError("write `nanoctl set-points` or `nanoctl set-points set NAME=VALUE ...`");
    set_some(session, {words.begin() + 1, words.end()});
}

Recipe recipe_named(const std::vector<Recipe>& recipes, const std::string& name) {
    const Recipe* recipe = set_points::find_recipe(recipes, name);
    if (recipe == nullptr) throw UserError(set_points::no_such_recipe(recipes, name));
    return *recipe;
}

/// `instead`: what happens to the other set-points.
std::string lack_text(const Recipe& recipe, const set_points::Record& record, std::string_view instead) {
    const std::string names = set_points::missing_values(recipe, record);
    return names.empty() ? "" : fmt::format("  (none for {}: {})", names, instead);
}

void list_recipes(Session& session) {
    const KeptSetPoints kept = read_set_points(session.gateway());
    const std::uint32_t active = active_recipe(kept);
    std::string text;
    Json all = Json::array();
    for (const Recipe& recipe : read_recipes(session.gateway(), kept)) {
        Json values = Json::object();
        std::string line = fmt::format("{}{}{} {:<16}", text.empty() ? "" : "\n",
                                       recipe.number == active ? '*' : ' ', recipe.number, recipe.name);
        for (const NewValue& value : recipe.values) {
            const set_points::SetPoint& point = kept.record.values[value.index];
            line += fmt::format("  {} {}", point.name, set_points::text_of(point, value.value));
            values[point.name] = set_points::shown_value(point, value.value);
        }
        line += lack_text(recipe, kept.record, "loading it sets the default");
        text += line;
        all.push_back({{"number", recipe.number},
                       {"name", recipe.name},
                       {"active", recipe.number == active},
                       {"values", values}});
    }
    session.tell(text.empty() ? "no recipe is saved" : text, {{"recipes", all}});
}

void save_recipe(Session& session, const std::string& name) {
    if (const std::string problem = set_points::recipe_name_problem(name); !problem.empty())
        throw UserError(problem);
    const KeptSetPoints kept = read_set_points(session.gateway());
    write_set_points(
        session.gateway(), kept.record,
        set_points::encode_request(kept.record, SetPointRequest::save_recipe, {}, {.name = name}));
    session.tell(fmt::format("the values are saved as recipe '{}'", name), {{"recipe", name}});
}

/// Loads or deletes the recipe of that name.
Recipe ask_for(SetPointRequest kind, Session& session, const std::string& name) {
    const KeptSetPoints kept = read_set_points(session.gateway());
    Recipe recipe = recipe_named(read_recipes(session.gateway(), kept), name);
    write_set_points(session.gateway(), kept.record,
                     set_points::encode_request(kept.record, kind, {}, {.name = recipe.name}));
    return recipe;
}

void load_recipe(Session& session, const std::string& name) {
    const Recipe recipe = ask_for(SetPointRequest::load_recipe, session, name);
    const KeptSetPoints kept = read_set_points(session.gateway());
    tell_set_points(session, kept, dropped_by_loading(recipe, kept));
}

void delete_recipe(Session& session, const std::string& name) {
    const Recipe recipe = ask_for(SetPointRequest::delete_recipe, session, name);
    session.tell(fmt::format("recipe '{}' is deleted", recipe.name), {{"recipe", recipe.name}});
}

struct ExportOptions {
    std::string file;
    bool force = false;
};

void export_to(Session& session, const ExportOptions& options) {
    if (const std::string why = whole_files::why_kept(options.file); !why.empty() && !options.force)
        throw UserError(why);
    const KeptSetPoints kept = read_set_points(session.gateway());
    const auto recipes = read_recipes(session.gateway(), kept);
    const std::string text =
        set_points::write_recipes(recipes, kept.record, set_points::format_of(options.file));
    if (const std::string problem = whole_files::write_files({{options.file, text}}); !problem.empty())
        throw UserError(problem);
    const auto count = std::count_if(recipes.begin(), recipes.end(),
                                     [](const Recipe& recipe) { return !recipe.values.empty(); });
    std::string told = fmt::format("{}: {} recipe{}", options.file, count, count == 1 ? "" : "s");
    for (const Recipe& recipe : recipes) {
        const std::string lack =
            lack_text(recipe, kept.record, "what it has of other tables is not in the file");
        if (!lack.empty()) told += fmt::format("\n  {}{}", recipe.name, lack);
    }
    session.tell(told, {{"file", options.file}, {"recipes", count}});
}

void store_all(Session& session, const KeptSetPoints& kept, const std::string& file,
               const std::vector<Recipe>& recipes) {
    for (std::size_t i = 0; i < recipes.size(); ++i) {
        const Recipe& recipe = recipes[i];
        const auto told = [&](const std::exception& error) {
            return fmt::format("{}: recipe '{}': {}; {} before it {} stored", file, recipe.name, error.what(),
                               i, i == 1 ? "is" : "are");
        };
        try {
            write_set_points(session.gateway(), kept.record,
                             set_points::encode_request(kept.record, SetPointRequest::put_recipe,
                                                        recipe.values, {.name = recipe.name}));
        } catch (const Refused& refused) {
            throw Refused(refused.result(), refused.reg(), refused.detail(), told(refused));
        } catch (const mactalk_client::LineError& error) {
            throw mactalk_client::LineError(error.kind(), told(error));
        }
    }
}

/// The whole file is checked before the first value is stored.
void import_from(Session& session, const std::string& file) {
    const std::string text = command_line::read_text(file);
    const KeptSetPoints kept = read_set_points(session.gateway());
    const set_points::RecipeReading read =
        set_points::read_recipes(text, kept.record, set_points::format_of(file));
    if (!read.error.empty()) throw UserError(fmt::format("{}:{}; nothing was imported", file, read.error));
    const std::string problem =
        set_points::recipe_room_problem(read_recipes(session.gateway(), kept), kept.recipes, read.recipes);
    if (!problem.empty()) throw UserError(fmt::format("{}: {}; nothing was imported", file, problem));
    store_all(session, kept, file, read.recipes);
    std::string told =
        fmt::format("{}: {} recipe{} stored; `nanoctl recipe load NAME` makes one the active one", file,
                    read.recipes.size(), read.recipes.size() == 1 ? "" : "s");
    for (const Recipe& recipe : read.recipes) {
        if (const std::string lack = lack_text(recipe, kept.record, "it has the present value");
            !lack.empty())
            told += fmt::format("\n  {}{}", recipe.name, lack);
    }
    session.tell(told, {{"file", file}, {"recipes", read.recipes.size()}});
}

}  // namespace

void add_set_points(arguments::App& app, Common& common) {
    auto [command, words] = add_command(app, common, "set-points",
                                        "The values that an operator may change, with their ranges; or "
                                        "change some, all at once or none: they are "
                                        "stored, and in force as soon as the program allows it",
                                        show_or_set);
    command.add_option("words", words,
                       "set NAME=VALUE ..., as in set Length=80mm Dwell='1.5 s'; nothing: show all");

    arguments::App& recipe = add_command(app, "recipe", "Sets of values under a name");
    recipe.require_subcommand(1);
    add_command(recipe, common, "list", "All of them with their numbers; * is the one that was loaded last",
                list_recipes);
    auto [saver, saved] = add_command(
        recipe, common, "save",
        "Save the present values under a name, in the place of those saved under it before", save_recipe);
    saver.add_option("name", saved, "Up to 15 characters")->required();
    auto [loader, loaded] = add_command(
        recipe, common, "load",
        "Make a recipe's values the present ones; of a value that it does not have the default", load_recipe);
    loader.add_option("name", loaded, "Case counts not")->required();
    auto [remover, removed] = add_command(recipe, common, "delete", "Delete a recipe", delete_recipe);
    remover.add_option("name", removed, "Case counts not")->required();
    auto [exporter, target] =
        add_command(recipe, common, "export", "Write all recipes into a file", export_to);
    exporter.add_option("file", target.file, "F.csv, or F.toml for TOML")->required();
    exporter.add_flag("--force", target.force, "Replace a file that is there");
    auto [importer, source] = add_command(recipe, common, "import",
                                          "Store the recipes of a file, one by one once all of it is sound; "
                                          "those of the same name are replaced",
                                          import_from);
    importer.add_option("file", source, "F.csv, or F.toml for TOML")->required();
}

}  // namespace nplc::nanoctl::cli
