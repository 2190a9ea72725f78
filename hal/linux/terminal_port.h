#pragma once

#include <termios.h>

#include <string>

#include "file_descriptor.h"

/// What every user of a serial line does to open it.
namespace nplc::hal_linux {

struct ExclusivePort {
    FileDescriptor descriptor;
    std::string error;  ///< one line that begins with the name, and says who holds it if anybody does
};
/// Reads and writes do not block. Nobody else can open or lock it.
ExclusivePort open_exclusively(const std::string& path, const std::string& name);

/// 8N1 without handshake; a read returns what there is.
termios raw_mode(termios mode, speed_t speed);

}  // namespace nplc::hal_linux
