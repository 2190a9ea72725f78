#pragma once

#include <cstdint>
#include <vector>

#include "sequencer/state.h"

namespace nplc::faces {

/// The active table of an axis, end term included; empty without one.
struct AxisTable {
    std::uint32_t crc = 0;
    std::vector<std::uint8_t> bytes{};
    /// As uploaded: set-points at their defaults, then the bytes after the end term.
    std::vector<std::uint8_t> uploaded{};

    /// Whether the term was true in a scan of this step with this key (FIRED_STEP, FIRED_KEY).
    bool fired(std::size_t term, std::uint8_t step, sequencer::Key key) const;
};

}  // namespace nplc::faces
