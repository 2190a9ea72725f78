#pragma once

#include "run_options.h"

namespace nplc::sim {

/// Before anything is written: no trace may land on one of the run's own inputs or on the other trace, under
/// whatever name. Throws InputError.
void check_outputs(const RunOptions& options);

}  // namespace nplc::sim
