#include "set_points/recipes.h"

#include <fmt/format.h>

#include <algorithm>

#include "registers/names.h"

namespace nplc::set_points {

bool is_same_recipe(std::string_view name, std::string_view other) {
    return registers::same_name(name, other);
}

std::string recipe_name_problem(std::string_view name) {
    if (name.empty() || name.size() > kLongestRecipeName)
        return fmt::format("'{}': a recipe's name has 1 to {} characters", name, kLongestRecipeName);
    const bool is_plain = std::all_of(name.begin(), name.end(), [](char c) { return c >= 0x20 && c < 0x7F; });
    if (!is_plain) return fmt::format("'{}': a recipe's name is plain ASCII", name);
    const bool is_visible = name.front() != ' ' && name.back() != ' ';
    return is_visible ? "" : fmt::format("'{}': a recipe's name neither begins nor ends with a blank", name);
}

const Recipe* find_recipe(const std::vector<Recipe>& recipes, std::string_view name) {
    const auto found = std::find_if(recipes.begin(), recipes.end(),
                                    [&](const Recipe& recipe) { return is_same_recipe(recipe.name, name); });
    return found == recipes.end() ? nullptr : &*found;
}

std::string no_such_recipe(const std::vector<Recipe>& recipes, std::string_view name) {
    std::string names;
    for (const Recipe& recipe : recipes)
        names += fmt::format("{}'{}'", names.empty() ? "" : ", ", recipe.name);
    return fmt::format("there is no recipe '{}'; {}", name,
                       names.empty() ? "none is saved" : "there are " + names);
}

std::string recipe_room_problem(const std::vector<Recipe>& kept, std::size_t room,
                                const std::vector<Recipe>& recipes) {
    const auto news =
        static_cast<std::size_t>(std::count_if(recipes.begin(), recipes.end(), [&](const Recipe& one) {
            return find_recipe(kept, one.name) == nullptr;
        }));
    if (kept.size() + news <= room) return {};
    if (kept.size() >= room)
        return fmt::format("all {} recipes are taken; delete one, or save under a name that is there", room);
    return fmt::format(
        "{} new recipes, and there is room for {}; delete others, or save under names that are there", news,
        room - kept.size());
}

}  // namespace nplc::set_points
