#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "broker/options.h"

namespace nplc::nanofleet {

/// Axes that are to run the same table.
struct Group {
    std::string name;
    std::string table;
    std::string symbols{};
    std::string proof{};
    std::vector<std::string> gateways{};  ///< GROUP/NODE/AXIS each
};

struct Fleet {
    broker::Options broker;
    std::vector<Group> groups{};

    /// Null: there is none of this name.
    const Group* find(std::string_view name) const;
};

struct FleetReading {
    Fleet fleet{};
    std::string error{};  ///< one line, with the file's line
};
/// Relative paths in it are relative to `folder`.
FleetReading read_fleet(std::string_view text, const std::string& folder);

}  // namespace nplc::nanofleet
