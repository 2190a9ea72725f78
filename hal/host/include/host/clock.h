#pragma once

#include "base/time.h"

namespace nplc::host {

/// The clock of all clients' now().
base::Instant steady_now();

}  // namespace nplc::host
