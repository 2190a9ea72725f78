#pragma once

#include "cli/session.h"
#include "nanofleet/fleet.h"

namespace nplc::nanofleet::cli {

/// The file of --fleet; an error is a UserError.
Fleet open_fleet(const Common& common);

/// Group `name`, or all; an unknown one is a UserError.
std::vector<Group> groups_of(const Fleet& fleet, const Common& common, const std::string& name);

/// "12 s", "3 min", "5 h".
std::string age_text(std::uint64_t then, std::uint64_t now);

}  // namespace nplc::nanofleet::cli
