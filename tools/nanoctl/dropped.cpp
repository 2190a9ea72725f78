// What became of kept values: read before and after, since the gateway's log has no room for names.
#include <algorithm>

#include "base/crc32.h"
#include "nanoctl/set_points.h"
#include "nanoctl/status.h"

namespace nplc::nanoctl {

using set_points::Dropped;

namespace {

/// Those that the gateway's log names for the active table.
std::uint16_t logged_mask(GatewayClient& gateway) {
    std::uint16_t mask = 0;
    for (const LogEntry& entry : read_log(gateway)) {
        const auto event = static_cast<gw::Event>(entry.event);
        if (event == gw::Event::table_activated) mask = 0;
        if (event == gw::Event::set_points_dropped) mask = entry.detail;
    }
    return mask;
}

bool is_among(const std::vector<Dropped>& all, std::string_view name) {
    return std::any_of(all.begin(), all.end(),
                       [&](const Dropped& one) { return one.recipe.empty() && one.name == name; });
}

/// The values that fit the record, differ from its default, and were replaced by it all the same.
void add_refused(std::vector<Dropped>& all, const ValuesBefore& before, const set_points::Record& now,
                 std::uint16_t mask) {
    for (std::size_t i = 0; i < now.values.size(); ++i) {
        const set_points::SetPoint& point = now.values[i];
        const set_points::SetPoint* old = set_points::find(before.kept.record, point.name);
        if ((mask >> i & 1U) == 0 || old == nullptr || is_among(all, old->name)) continue;
        const std::int32_t value =
            before.kept
                .wanted[static_cast<std::size_t>(std::distance(before.kept.record.values.data(), old))];
        if (value != old->initial && value != point.initial)
            all.push_back(set_points::refused_by_motor(point, value));
    }
}

}  // namespace

std::optional<ValuesBefore> read_before(GatewayClient& gateway, const set_points::Record& next) {
    if ((gateway.read(gw::SET_POINT_COUNT) & 0xFF) == 0) return std::nullopt;
    if (gateway.read(gw::SET_POINT_RECORD) == base::crc32(set_points::encode(next))) return std::nullopt;
    try {
        ValuesBefore before{read_set_points(gateway), {}};
        before.recipes = read_recipes(gateway, before.kept);
        return before;
    } catch (const Refused&) {
        return std::nullopt;
    }
}

std::vector<Dropped> foreseen_drops(const ValuesBefore& before, const set_points::Record& next) {
    return set_points::dropped_by({before.kept.record, before.kept.wanted, before.recipes}, next);
}

std::vector<Dropped> read_dropped(GatewayClient& gateway, const std::optional<ValuesBefore>& before,
                                  const set_points::Record& now) {
    std::vector<Dropped> all;
    const std::uint16_t mask = now.values.empty() ? std::uint16_t{0} : logged_mask(gateway);
    if (before) {
        all = foreseen_drops(*before, now);
        add_refused(all, *before, now, mask);
        return all;
    }
    for (std::size_t i = 0; i < now.values.size(); ++i) {
        if ((mask >> i & 1U) != 0) all.push_back(set_points::without_fit(now.values[i]));
    }
    return all;
}

std::vector<Dropped> dropped_by_loading(const set_points::Recipe& recipe, const KeptSetPoints& kept) {
    std::vector<Dropped> all = set_points::misfits_of(recipe, kept.record);
    for (const set_points::NewValue& value : recipe.values) {
        if (kept.wanted[value.index] == value.value) continue;
        all.push_back(set_points::refused_by_motor(kept.record.values[value.index], value.value));
        all.back().recipe = recipe.name;
    }
    return all;
}

}  // namespace nplc::nanoctl
