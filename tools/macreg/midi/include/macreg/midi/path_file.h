#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "macreg/midi/values.h"
#include "midi_client/plan.h"

/// A path of several axes as text: what a spreadsheet writes.
///
///     # time in seconds, a column an axis: its address, and inc or rev
///     time,0 [inc],1 [rev]
///     0,0,0
///     0.5,1000,0.25
namespace nplc::macreg::midi {

struct PathFile {
    std::vector<std::uint8_t> addresses{};
    std::vector<midi_client::Waypoint> path{};  ///< absolute positions
    std::vector<std::string> problems{};        ///< "line 3: ...", all of them; empty if the file is valid
};
PathFile read_path(std::string_view text, const Scale& scale);

}  // namespace nplc::macreg::midi
