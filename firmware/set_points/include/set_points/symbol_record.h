#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

namespace nplc::set_points {

/// The appendix for the upload of a table: the record of the set-points in its symbol file, empty if there
/// are none. No value if they do not fit the table.
std::optional<std::vector<std::uint8_t>> record_in(const nlohmann::json& symbols,
                                                   std::span<const std::uint8_t> table);

}  // namespace nplc::set_points
