#pragma once

#include <cstdint>

namespace nplc::hal_linux {

/// Sets any speed that the driver supports; the rest of the line's mode is kept. False with errno.
bool set_any_baud(int descriptor, std::uint32_t baud);

/// The speed that the driver has set; 0 if unknown.
std::uint32_t present_baud(int descriptor);

}  // namespace nplc::hal_linux
