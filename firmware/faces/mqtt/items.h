#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "faces/axis_model.h"
#include "sparkplug.h"

namespace nplc::mqtt {

/// A value of an axis as a Sparkplug metric.
struct Item {
    std::string name{};
    std::string unit{};
    std::string text{};
    DataType type = DataType::real64;
    std::function<faces::PointValue(const faces::AxisImage&, base::Instant)> take{};
    std::optional<double> lowest{};  ///< in the unit
    std::optional<double> highest{};
    std::optional<std::size_t> set_point{};  ///< its index in the book
};

constexpr std::string_view kSetPoints = "Set Points/";
constexpr std::string_view kRecipe = "Set Points/Recipe";

/// The published points of the model; the same for every axis and book.
std::vector<Item> point_items(const faces::Scaling& scaling);
/// Items of a table's set-points; empty if it has none.
std::vector<Item> set_point_items(const std::shared_ptr<const faces::SetPointBook>& book);

Value value_of(const Item& item, const faces::PointValue& value);

}  // namespace nplc::mqtt
