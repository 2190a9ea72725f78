#pragma once

#include <cstdint>

namespace nplc::gateway {

inline constexpr std::uint32_t kFirmwareVersion = 0x0000'0100;  ///< 0.1.0, as CMakeLists.txt has it

}  // namespace nplc::gateway
