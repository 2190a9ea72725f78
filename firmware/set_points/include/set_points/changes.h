#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "registers/vocabulary.h"
#include "set_points/record.h"

/// The last values that were changed, as a gateway shows them (REGISTERS.md, Set-points): what the event log
/// only counts.
namespace nplc::set_points {

struct Change {
    std::uint32_t milliseconds = 0;  ///< of uptime, as in the event log
    std::size_t index = 0;           ///< in the record
    registers::gateway::Origin by{};
    std::uint8_t recipe = 0;  ///< that brought it; 0: none
    std::int32_t before = 0;  ///< in the steps of what takes it
    std::int32_t now = 0;
    bool operator==(const Change&) const = default;
};

/// From the bytes of the view of changes; the oldest first.
std::vector<Change> decode_changes(std::span<const std::uint8_t> bytes, const Record& record);

/// "Length 80 mm to 100 mm, Pieces 3 to 5": what was changed at this uptime; empty if nothing is known of it.
std::string changes_text(const std::vector<Change>& changes, const Record& record,
                         std::uint32_t milliseconds);

/// "Length, Pieces": those whose bit is set.
std::string names_of(const Record& record, std::uint32_t mask);

}  // namespace nplc::set_points
