#pragma once

#include <cerrno>
#include <cstring>
#include <string>

namespace nplc::hal_linux {

/// What errno says, in words.
inline std::string reason() {
    return std::strerror(errno);
}

}  // namespace nplc::hal_linux
