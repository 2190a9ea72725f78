#pragma once

#include "motor/driver.h"
#include "motor/family_drivers.h"

namespace nplc::motor {

/// The driver of whatever drive there is, among all families of this program.
using AnyDriver = DriverPlace<NPLC_FAMILY_DRIVERS>;

}  // namespace nplc::motor
