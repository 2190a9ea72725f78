#pragma once

#include <string>

#include "gateway/version.h"

namespace nplc::faces {

/// "0.1.0", of the firmware.
inline std::string program_version() {
    constexpr std::uint32_t kVersion = gateway::kFirmwareVersion;
    return std::to_string(kVersion >> 16) + "." + std::to_string(kVersion >> 8 & 0xFF) + "." +
           std::to_string(kVersion & 0xFF);
}

}  // namespace nplc::faces
