#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

namespace nplc::set_points {

/// What is uploaded behind a table: the record of the set-points that its symbol file has, empty if it has
/// none. Nothing if they do not fit the table.
std::optional<std::vector<std::uint8_t>> record_in(const nlohmann::json& symbols,
                                                   std::span<const std::uint8_t> table);

}  // namespace nplc::set_points
