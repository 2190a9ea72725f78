#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "set_points/request.h"

/// Recipes by name.
namespace nplc::set_points {

/// Error of a recipe's name; empty if valid.
std::string recipe_name_problem(std::string_view name);

/// Case-insensitive.
bool is_same_recipe(std::string_view name, std::string_view other);
/// Null if there is none.
const Recipe* find_recipe(const std::vector<Recipe>& recipes, std::string_view name);

/// "there is no recipe 'X'; there are ...".
std::string no_such_recipe(const std::vector<Recipe>& recipes, std::string_view name);
/// Why they cannot all be saved in `room` places; empty if they can at present.
std::string recipe_room_problem(const std::vector<Recipe>& kept, std::size_t room,
                                const std::vector<Recipe>& recipes);

}  // namespace nplc::set_points
