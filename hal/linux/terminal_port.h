#pragma once

#include <termios.h>

#include <string>

#include "file_descriptor.h"

/// Opening of a serial line.
namespace nplc::hal_linux {

struct OpenedPort {
    FileDescriptor descriptor;
    std::string error;  ///< one line that begins with the name, with the holder if there is one
};
/// Non-blocking. No other program can open or lock it.
OpenedPort open_exclusively(const std::string& path, const std::string& name);
/// The same without a lock.
OpenedPort open_unheld(const std::string& path, const std::string& name);
/// "minicom (process 1234) holds this port; end it first", if another program has locked the port.
std::string held_by_another(const std::string& name, const std::string& path);
/// "minicom (process 1234)"; empty if there is none whose files we may read.
std::string holder_of(const std::string& path);

/// 8N1 without handshake; a read returns the available bytes. 11h and 13h are data: cfmakeraw does not clear
/// IXOFF and IXANY.
inline constexpr tcflag_t kFlowControl = IXON | IXOFF | IXANY;
termios raw_mode(termios mode, speed_t speed);

}  // namespace nplc::hal_linux
