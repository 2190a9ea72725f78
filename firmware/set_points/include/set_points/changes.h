#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "registers/vocabulary.h"
#include "set_points/record.h"

/// The latest changed values in a gateway (REGISTERS.md, Set-points), which the event log only counts.
namespace nplc::set_points {

struct Change {
    std::uint32_t milliseconds = 0;  ///< of uptime, as in the event log
    std::size_t index = 0;           ///< in the record
    registers::gateway::Origin by{};
    std::uint8_t recipe = 0;  ///< recipe that caused it; 0: none
    std::int32_t before = 0;  ///< in raw steps
    std::int32_t now = 0;
    bool operator==(const Change&) const = default;
};

/// Decodes the view of changes; the oldest first.
std::vector<Change> decode_changes(std::span<const std::uint8_t> bytes, const Record& record);

/// "Length 80 mm to 100 mm, Pieces 3 to 5": the changes at this uptime; empty if none is known. For the
/// oldest one kept the text adds that there may have been more.
std::string changes_text(const std::vector<Change>& changes, const Record& record,
                         std::uint32_t milliseconds);

/// "Length, Pieces": those in the bit mask.
std::string names_of(const Record& record, std::uint32_t mask);

}  // namespace nplc::set_points
