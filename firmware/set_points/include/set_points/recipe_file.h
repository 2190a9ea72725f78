#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "set_points/request.h"

/// Recipe files for editing by hand or in spreadsheets: CSV with the header `recipe,set_point,value,unit`, or
/// TOML with a [[recipe]] each, its `name` and its `values`, texts such as "80 mm".
namespace nplc::set_points {

enum class RecipeFormat : std::uint8_t { csv, toml };

/// By the file name: .toml, else CSV.
RecipeFormat format_of(std::string_view path);

/// "Dwell, Parts": the set-points without a value in the recipe, empty for none: loading it sets them to
/// their defaults.
std::string missing_values(const Recipe& recipe, const Record& record);

/// Without recipes that have no value for the record.
std::string write_recipes(const std::vector<Recipe>& recipes, const Record& record, RecipeFormat format);

struct RecipeReading {
    std::vector<Recipe> recipes;  ///< without numbers
    std::string error;            ///< "3: the error"; empty: all recipes are valid
};

/// Checks each value against the record: name, unit, range and STEP.
RecipeReading read_recipes(std::string_view text, const Record& record, RecipeFormat format);

}  // namespace nplc::set_points
