#include "set_points/changes.h"

#include <fmt/format.h>

#include "base/bytes.h"
#include "registers/gateway.h"
#include "set_points/values.h"

namespace nplc::set_points {

std::vector<Change> decode_changes(std::span<const std::uint8_t> bytes, const Record& record) {
    std::vector<Change> changes;
    for (std::size_t end = bytes.size(); end >= registers::gateway::kChangeBytes;
         end -= registers::gateway::kChangeBytes) {
        const std::uint8_t* at = &bytes[end - registers::gateway::kChangeBytes];
        const bool is_one = at[5] != 0 && at[4] < record.values.size();
        if (!is_one) continue;
        changes.push_back({.milliseconds = base::load_u32(at),
                           .index = at[4],
                           .by = static_cast<registers::gateway::Origin>(at[5]),
                           .recipe = at[6],
                           .before = static_cast<std::int32_t>(base::load_u32(at + 8)),
                           .now = static_cast<std::int32_t>(base::load_u32(at + 12))});
    }
    return changes;
}

std::string changes_text(const std::vector<Change>& changes, const Record& record,
                         std::uint32_t milliseconds) {
    constexpr std::size_t kKept = 16;
    std::string text;
    for (const Change& change : changes) {
        if (change.milliseconds != milliseconds) continue;
        const SetPoint& point = record.values[change.index];
        text += fmt::format("{}{} {} to {}", text.empty() ? "" : ", ", point.name,
                            text_of(point, change.before), text_of(point, change.now));
    }
    if (changes.size() == kKept && changes.front().milliseconds == milliseconds)
        text += ", and perhaps values that are not kept any more";
    return text;
}

std::string names_of(const Record& record, std::uint32_t mask) {
    std::string names;
    for (std::size_t i = 0; i < record.values.size(); ++i) {
        if ((mask >> i & 1) != 0) names += (names.empty() ? "" : ", ") + record.values[i].name;
    }
    return names;
}

}  // namespace nplc::set_points
