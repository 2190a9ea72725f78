#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config.h"
#include "gateway/settings_manager.h"
#include "gateway/table_manager.h"
#include "ports/storage.h"
#include "store/layout.h"

/// An axis's stored data, which take precedence over its configuration.
namespace nplc::boards {

/// A store as flash pages of 2 KiB: two table slots of five pages, two settings slots and two set-point slots
/// of one page each.
inline constexpr ports::StorageGeometry kMemory{
    .size = 32 * 1024, .erase_block = 2048, .program_page = 256, .program_unit = 8};
inline constexpr store::Area kTableArea{.begin = 0, .slot_bytes = 5 * 2048};
inline constexpr store::Area kSettingsArea{.begin = 10 * 2048, .slot_bytes = 2048};
inline constexpr store::Area kSetPointArea{.begin = 12 * 2048, .slot_bytes = 2048};
std::string store_file(const std::string& folder);

/// The motor is defined by the configuration, whatever was stored.
void impose_motor(gateway::SettingsManager& settings, const AxisConfig& config);

struct StoredSetting {
    std::string_view name;
    std::uint32_t stored;
    std::uint32_t configured;
};
/// The stored settings that differ from the configuration.
std::vector<StoredSetting> stored_settings(const gateway::SettingsManager& settings,
                                           const AxisConfig& config);

/// Result of loading the first table: the stored one, or the configured one while none is stored.
struct LoadedTable {
    std::string where_from{};  ///< one line
    std::string fault{};       ///< why it cannot run, one line; empty: it can, or there is no table
    bool is_configured = false;
};
/// As in the start of an axis.
LoadedTable load_first_table(gateway::TableManager& tables, const gateway::SettingsManager& settings,
                             const AxisConfig& config, base::Instant now);

struct StoredFindings {
    std::vector<Mistake> troubles;   ///< with any, the axis will not run as it is
    std::vector<std::string> notes;  ///< what differs from the configuration, a line each
};
/// Checks what the service would do with its axes' stored data. Changes nothing.
StoredFindings look_at_stored(const Config& config);

}  // namespace nplc::boards
