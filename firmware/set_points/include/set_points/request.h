#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "registers/vocabulary.h"
#include "set_points/record.h"

/// Requests to a gateway's SET_POINT_WRITE, and its view of recipes (REGISTERS.md, Set-points).
namespace nplc::set_points {

struct NewValue {
    std::size_t index = 0;  ///< in the record
    std::int32_t value = 0;
};

inline constexpr std::size_t kLongestRecipeName = 15;

/// Identifies a recipe: for saving or putting by its name; for loading or deleting by its name, its number,
/// or both, which must then belong together.
struct RecipeRef {
    std::uint8_t number = 0;
    std::string_view name{};
};

/// `values` for a change and put_recipe, `recipe` for everything except a change.
std::vector<std::uint8_t> encode_request(const Record& record, registers::gateway::SetPointRequest kind,
                                         std::vector<NewValue> values, const RecipeRef& recipe = {});
/// Sets the number by which the gateway recognizes a repeated request and reports its outcome. Without it: 0.
void give_number(std::span<std::uint8_t> request, std::uint32_t own_number);

/// A saved value that no set-point of the record takes.
struct Misfit {
    std::uint32_t name_hash = 0;  ///< hash_of() its set-point's name
    std::int32_t value = 0;
    std::uint8_t unit_code = 0;
};

struct Recipe {
    std::uint8_t number = 0;
    std::string name;
    std::vector<NewValue> values;  ///< those that match a set-point of the record in name, unit and range
    std::vector<Misfit> misfits{};
};

/// Decodes a recipe's view; an empty name: there is none.
Recipe decode_recipe(std::span<const std::uint8_t> bytes, const Record& record, std::uint8_t number);

inline constexpr std::size_t kRecipeBytes = 160;

}  // namespace nplc::set_points
