#include "set_points/recipe_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/csv_row.h"
#include "registers/names.h"
#include "set_points/recipes.h"
#include "set_points/values.h"
#include "toml_files/toml_file.h"

namespace nplc::set_points {
namespace {

constexpr std::string_view kHeader = "recipe,set_point,value,unit";

/// Collects the contents of a file, and its first error.
class Gatherer {
  public:
    explicit Gatherer(const Record& record) : record_(record) {}

    bool fail(std::size_t line, const std::string& what) {
        if (reading_.error.empty()) reading_.error = fmt::format("{}: {}", line, what);
        return false;
    }

    /// Case does not count in names of recipes, so another spelling would replace the first one.
    bool begin(std::size_t line, const std::string& name) {
        if (const std::string problem = recipe_name_problem(name); !problem.empty())
            return fail(line, problem);
        const auto same = [&](const Recipe& recipe) { return is_same_recipe(recipe.name, name); };
        current_ = static_cast<std::size_t>(
            std::find_if(reading_.recipes.begin(), reading_.recipes.end(), same) - reading_.recipes.begin());
        if (current_ == reading_.recipes.size()) {
            reading_.recipes.push_back({0, name, {}});
            lines_.push_back(line);
        }
        const std::string& first = reading_.recipes[current_].name;
        return first == name || fail(line, fmt::format("'{}' is the recipe '{}' of line {}; case counts not",
                                                       name, first, lines_[current_]));
    }

    /// As begin(); a recipe that stands twice is an error.
    bool begin_another(std::size_t line, const std::string& name) {
        const std::size_t before = reading_.recipes.size();
        if (!begin(line, name)) return false;
        return reading_.recipes.size() > before ||
               fail(line, fmt::format("recipe '{}' stands in line {} already", name, lines_[current_]));
    }

    bool add(std::size_t line, const std::string& name, const std::string& text) {
        const SetPoint* point = find(record_, name);
        if (point == nullptr) return fail(line, fmt::format("the table has no set-point '{}'", name));
        const Reading value = read_value(*point, text);
        if (!value.error.empty()) return fail(line, value.error);
        const auto index = static_cast<std::size_t>(point - record_.values.data());
        std::vector<NewValue>& values = reading_.recipes[current_].values;
        const bool twice =
            std::any_of(values.begin(), values.end(), [&](const NewValue& v) { return v.index == index; });
        if (twice) return fail(line, fmt::format("'{}' stands twice in this recipe", name));
        values.push_back({index, value.value});
        return true;
    }

    RecipeReading take() {
        for (std::size_t i = 0; i < reading_.recipes.size(); ++i) {
            const Recipe& recipe = reading_.recipes[i];
            if (recipe.values.empty()) fail(lines_[i], fmt::format("recipe '{}' has no values", recipe.name));
        }
        if (reading_.recipes.empty()) fail(1, "there is no recipe in it");
        if (!reading_.error.empty()) reading_.recipes.clear();
        return std::move(reading_);
    }

  private:
    const Record& record_;
    RecipeReading reading_;
    std::vector<std::size_t> lines_;  ///< where each begins
    std::size_t current_ = 0;
};

/// "a ""b""", or plain up to the comma.
std::string quoted(std::string_view text) {
    if (text.find_first_of(",\"") == text.npos) return std::string(text);
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
    return result + "\"";
}

/// Empty if a quote is not closed.
std::vector<std::string> fields_of(std::string_view line) {
    std::vector<std::string> fields(1);
    bool inside = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"' && inside && i + 1 < line.size() && line[i + 1] == '"') {
            fields.back() += line[i++];
        } else if (line[i] == '"') {
            inside = !inside;
        } else if (line[i] == ',' && !inside) {
            fields.emplace_back();
        } else {
            fields.back() += line[i];
        }
    }
    if (inside) fields.clear();
    return fields;
}

/// Splits "80 mm" into "80" and "mm".
std::pair<std::string, std::string> parted(const std::string& text) {
    const std::size_t blank = text.find(' ');
    if (blank == text.npos) return {text, ""};
    return {text.substr(0, blank), text.substr(blank + 1)};
}

std::string toml_text(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result + "\"";
}

/// A last line without line end and without an expected unit: it may be truncated.
bool is_cut_short(const std::vector<std::string>& fields, const Record& record) {
    const SetPoint* point = find(record, fields[1]);
    return fields[3].empty() && point != nullptr && !point->unit.empty();
}

RecipeReading read_csv(std::string_view text, const Record& record) {
    Gatherer gatherer(record);
    std::size_t number = 0;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        const bool is_open = end == text.npos;
        std::string_view line = text.substr(0, end);
        text = is_open ? std::string_view() : text.substr(end + 1);
        ++number;
        if (line.ends_with('\r')) line.remove_suffix(1);
        if (number == 1) {
            if (line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
            if (line != kHeader && !gatherer.fail(1, fmt::format("the header is not {}", kHeader))) break;
            continue;
        }
        if (base::is_blank_row(line)) continue;
        const std::vector<std::string> fields = fields_of(line);
        if (fields.empty()) {
            gatherer.fail(number, "a quote is open at the end of the line");
            break;
        }
        if (fields.size() == 4 && is_open && is_cut_short(fields, record)) {
            gatherer.fail(number,
                          fmt::format("the file ends without the unit of {}: is it whole?", fields[1]));
            break;
        }
        if (fields.size() != 4) {
            gatherer.fail(number, fmt::format("{} fields, there must be 4: {}", fields.size(), kHeader));
            break;
        }
        if (!gatherer.begin(number, fields[0]) ||
            !gatherer.add(number, fields[1], fields[2] + " " + fields[3]))
            break;
    }
    return gatherer.take();
}

using Toml = toml_files::Value;

bool is_text(const Toml* value) {
    return value != nullptr && value->kind == Toml::Kind::text;
}

/// What is none of `known` would be passed over in silence.
bool has_only(const Toml& table, const std::vector<std::string_view>& known, Gatherer& gatherer) {
    for (const auto& [key, value] : table.entries) {
        if (std::find(known.begin(), known.end(), key) == known.end())
            return gatherer.fail(
                static_cast<std::size_t>(std::max(value.line, 1)),
                fmt::format("'{}' is no key here; {}", key,
                            known.size() == 1 ? "recipes are written as [[recipe]]"
                                              : "a [[recipe]] has a name and [recipe.values]"));
    }
    return true;
}

bool read_recipe(const Toml& table, Gatherer& gatherer) {
    if (!has_only(table, {"name", "values"}, gatherer)) return false;
    const Toml* name = table.find("name");
    const Toml* values = table.find("values");
    if (!is_text(name) || values == nullptr || values->kind != Toml::Kind::table)
        return gatherer.fail(static_cast<std::size_t>(table.line),
                             "a [[recipe]] needs a name and [recipe.values]");
    if (!gatherer.begin_another(static_cast<std::size_t>(table.line), name->text)) return false;
    for (const auto& [key, value] : values->entries) {
        const auto at = static_cast<std::size_t>(value.line);
        const bool is_number = value.kind == Toml::Kind::integer || value.kind == Toml::Kind::real;
        if (!is_text(&value) && !is_number)
            return gatherer.fail(at, fmt::format("'{}' is no text such as \"80 mm\", nor a number", key));
        if (!gatherer.add(at, key, is_number ? fmt::format("{}", value.real) : value.text)) return false;
    }
    return true;
}

RecipeReading read_toml(std::string_view text, const Record& record) {
    Gatherer gatherer(record);
    const toml_files::File file = toml_files::read_toml(text);
    if (!file.error.empty()) {
        gatherer.fail(static_cast<std::size_t>(file.line), file.error);
        return gatherer.take();
    }
    if (!has_only(file.root, {"recipe"}, gatherer)) return gatherer.take();
    const Toml* recipes = file.root.find("recipe");
    const bool is_list = recipes != nullptr && recipes->kind == Toml::Kind::list;
    for (std::size_t i = 0; is_list && i < recipes->items.size(); ++i) {
        const Toml& one = recipes->items[i];
        if (one.kind != Toml::Kind::table) {
            gatherer.fail(static_cast<std::size_t>(one.line), "recipes are written as [[recipe]]");
            break;
        }
        if (!read_recipe(one, gatherer)) break;
    }
    return gatherer.take();
}

}  // namespace

RecipeFormat format_of(std::string_view path) {
    constexpr std::string_view kEnd = ".toml";
    const std::string_view end = path.substr(path.size() - std::min(path.size(), kEnd.size()));
    return registers::same_name(end, kEnd) ? RecipeFormat::toml : RecipeFormat::csv;
}

std::string missing_values(const Recipe& recipe, const Record& record) {
    std::string names;
    for (std::size_t i = 0; i < record.values.size(); ++i) {
        const bool is_there = std::any_of(recipe.values.begin(), recipe.values.end(),
                                          [&](const NewValue& value) { return value.index == i; });
        if (!is_there) names += (names.empty() ? "" : ", ") + record.values[i].name;
    }
    return names;
}

std::string write_recipes(const std::vector<Recipe>& recipes, const Record& record, RecipeFormat format) {
    std::string text = format == RecipeFormat::csv ? std::string(kHeader) + "\n" : "";
    for (const Recipe& recipe : recipes) {
        if (recipe.values.empty()) continue;
        if (format == RecipeFormat::toml)
            text += fmt::format("{}[[recipe]]\nname = {}\n[recipe.values]\n", text.empty() ? "" : "\n",
                                toml_text(recipe.name));
        for (const NewValue& value : recipe.values) {
            const SetPoint& point = record.values[value.index];
            const std::string shown = text_of(point, value.value);
            const auto [number, unit] = parted(shown);
            text += format == RecipeFormat::toml
                        ? fmt::format("{} = {}\n", point.name, toml_text(shown))
                        : fmt::format("{},{},{},{}\n", quoted(recipe.name), point.name, number, quoted(unit));
        }
    }
    return text;
}

RecipeReading read_recipes(std::string_view text, const Record& record, RecipeFormat format) {
    return format == RecipeFormat::csv ? read_csv(text, record) : read_toml(text, record);
}

}  // namespace nplc::set_points
