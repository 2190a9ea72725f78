#pragma once

#include "motor/driver.h"
#include "motor/family_drivers.h"

namespace nplc::motor {

/// A driver of any drive family in this program.
using AnyDriver = DriverPlace<NPLC_FAMILY_DRIVERS>;

}  // namespace nplc::motor
