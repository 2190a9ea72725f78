#pragma once

#include <string>

#include "faces/axis_model.h"

namespace nplc::metrics {

/// All axes in Prometheus's text format 0.0.4. What is not known has no line: of the motor what was not read
/// lately, of an axis whose loop has left no image for 1 s all but `nanoplc_axis_up`, which is 0. `program`:
/// its version.
std::string exposition(const faces::Axes& axes, const std::string& program, base::Instant now);

/// Names and meanings as a table for documents.
std::string metrics_as_markdown();

}  // namespace nplc::metrics
