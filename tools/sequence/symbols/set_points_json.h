#pragma once

#include <nlohmann/json.hpp>

#include "set_points/record.h"

namespace nplc::seqc {

/// The set-points of a table for F.sym and reports, one object each.
nlohmann::ordered_json json_of(const set_points::Record& record);
/// The steps that take changed values.
nlohmann::ordered_json takes_of(const set_points::Record& record);

}  // namespace nplc::seqc
