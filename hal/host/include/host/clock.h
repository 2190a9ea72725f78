#pragma once

#include "base/time.h"

namespace nplc::host {

/// The time that a client's now() is of.
base::Instant steady_now();

}  // namespace nplc::host
