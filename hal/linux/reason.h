#pragma once

#include <cerrno>
#include <cstring>
#include <string>

namespace nplc::hal_linux {

/// The text of errno.
inline std::string reason() {
    return std::strerror(errno);
}

}  // namespace nplc::hal_linux
