#pragma once

#include <cstdint>

namespace nplc::hal_linux {

/// Any speed that the driver can make; the rest of the line's mode stays. False with errno.
bool set_any_baud(int descriptor, std::uint32_t baud);

/// What the driver made of it; 0 if it does not say.
std::uint32_t present_baud(int descriptor);

}  // namespace nplc::hal_linux
