#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "set_points/request.h"

/// Recipes by their names, as people have them.
namespace nplc::set_points {

/// What is wrong with a recipe's name; empty if nothing.
std::string recipe_name_problem(std::string_view name);

/// Case counts not.
bool is_same_recipe(std::string_view name, std::string_view other);
/// Null if there is none.
const Recipe* find_recipe(const std::vector<Recipe>& recipes, std::string_view name);

/// "there is no recipe 'X'; there are ...".
std::string no_such_recipe(const std::vector<Recipe>& recipes, std::string_view name);
/// Why they cannot all be saved where `room` are kept; empty if they can, as things stand.
std::string recipe_room_problem(const std::vector<Recipe>& kept, std::size_t room,
                                const std::vector<Recipe>& recipes);

}  // namespace nplc::set_points
