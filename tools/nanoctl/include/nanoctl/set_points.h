#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "nanoctl/gateway_client.h"
#include "set_points/changes.h"
#include "set_points/dropped.h"
#include "set_points/request.h"

/// The set-points and recipes of a gateway.
namespace nplc::nanoctl {

struct KeptSetPoints {
    set_points::Record record;
    std::size_t recipes = 0;  ///< capacity
    std::uint32_t state = 0;  ///< SET_POINT_STATE
    std::vector<std::int32_t> in_force;
    std::vector<std::int32_t> wanted;
};

/// The gateway's firmware supports set-points.
bool takes_set_points(GatewayClient& gateway);

/// Throws Refused if its firmware does not support them or the active table has none.
KeptSetPoints read_set_points(GatewayClient& gateway);

/// Those that have a name.
std::vector<set_points::Recipe> read_recipes(GatewayClient& gateway, const KeptSetPoints& kept);

/// The last changes of the active table's values, the oldest first; none if it has no set-points.
struct KnownChanges {
    set_points::Record record;
    std::vector<set_points::Change> changes;
    std::uint32_t record_since = 0;  ///< the first log entry that belongs to the active table
};
KnownChanges read_changes(GatewayClient& gateway);

/// The values and recipes of the active table before another one takes its place.
struct ValuesBefore {
    KeptSetPoints kept;
    std::vector<set_points::Recipe> recipes;
};
/// None if its firmware does not support them, the active table has none, or the very record `next`, or if
/// they cannot be read: that is no reason to upload nothing.
std::optional<ValuesBefore> read_before(GatewayClient& gateway, const set_points::Record& next);
/// The values and recipes that a table with the record `next` will not accept, as far as the record shows.
std::vector<set_points::Dropped> foreseen_drops(const ValuesBefore& before, const set_points::Record& next);
/// What the table that has just become active, with the record `now`, did not take.
std::vector<set_points::Dropped> read_dropped(GatewayClient& gateway,
                                              const std::optional<ValuesBefore>& before,
                                              const set_points::Record& now);
/// Of a recipe that was just loaded, what was not taken of it; `kept` was read afterwards.
std::vector<set_points::Dropped> dropped_by_loading(const set_points::Recipe& recipe,
                                                    const KeptSetPoints& kept);
/// Of the active table; empty without set-points.
set_points::Record read_active_record(GatewayClient& gateway);

/// Carries a request out completely or not at all, once, and waits for its end even if the gateway stores
/// slowly; Refused names the value and its limits. `request` without a number of its own.
void write_set_points(GatewayClient& gateway, const set_points::Record& record,
                      std::vector<std::uint8_t> request);

}  // namespace nplc::nanoctl
