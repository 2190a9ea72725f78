#pragma once

#include <string>

#include "faces/axis_model.h"

namespace nplc::metrics {

/// All axes in Prometheus's text format 0.0.4. Unknown values are omitted: motor values that are not recent,
/// and for an axis without an image for 1 s everything except `nanoplc_axis_up`, which is 0. `program`: its
/// version.
std::string exposition(const faces::Axes& axes, const std::string& program, base::Instant now);

/// Names and meanings as a table for the documentation.
std::string metrics_as_markdown();

}  // namespace nplc::metrics
