#include "cli/fleet.h"

#include <fmt/format.h>

#include <filesystem>

#include "command_line/files.h"

namespace nplc::nanofleet::cli {

Fleet open_fleet(const Common& common) {
    FleetReading reading = read_fleet(command_line::read_text(common.fleet),
                                      std::filesystem::path(common.fleet).parent_path().string());
    if (!reading.error.empty()) throw UserError(fmt::format("{}:{}", common.fleet, reading.error));
    return std::move(reading.fleet);
}

std::vector<Group> groups_of(const Fleet& fleet, const Common& common, const std::string& name) {
    if (name.empty()) return fleet.groups;
    if (const Group* group = fleet.find(name)) return {*group};
    throw UserError(fmt::format("{}: there is no group {}", common.fleet, name));
}

std::string age_text(std::uint64_t then, std::uint64_t now) {
    constexpr std::uint64_t kMinute = 60;
    constexpr std::uint64_t kHour = 3'600;
    const std::uint64_t seconds = now > then ? (now - then) / 1000 : 0;
    if (seconds < 2 * kMinute) return fmt::format("{} s", seconds);
    if (seconds < 2 * kHour) return fmt::format("{} min", seconds / kMinute);
    return fmt::format("{} h", seconds / kHour);
}

}  // namespace nplc::nanofleet::cli
