#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "registers/vocabulary.h"
#include "set_points/record.h"

/// What is written to a gateway's SET_POINT_WRITE, and what it shows of recipes (REGISTERS.md, Set-points).
namespace nplc::set_points {

struct NewValue {
    std::size_t index = 0;  ///< in the record
    std::int32_t value = 0;
};

inline constexpr std::size_t kLongestRecipeName = 15;

/// Which recipe: one to save or put by its name; one to load or delete by its name, its number, or both,
/// which must then belong together.
struct RecipeRef {
    std::uint8_t number = 0;
    std::string_view name{};
};

/// `values` for a change and put_recipe, `recipe` for all but a change.
std::vector<std::uint8_t> encode_request(const Record& record, registers::gateway::SetPointRequest kind,
                                         std::vector<NewValue> values, const RecipeRef& recipe = {});
/// By which the gateway knows the same request again, and tells how it ended. Without it: 0.
void give_number(std::span<std::uint8_t> request, std::uint32_t own_number);

struct Recipe {
    std::uint8_t number = 0;
    std::string name;
    std::vector<NewValue> values;  ///< those that the record has with the same name, unit and a fitting range
};

/// From the bytes of a recipe's view; an empty name: there is none.
Recipe decode_recipe(std::span<const std::uint8_t> bytes, const Record& record, std::uint8_t number);

inline constexpr std::size_t kRecipeBytes = 160;

}  // namespace nplc::set_points
