#pragma once

#include <termios.h>

#include <string>

#include "file_descriptor.h"

/// What every user of a serial line does to open it.
namespace nplc::hal_linux {

struct OpenedPort {
    FileDescriptor descriptor;
    std::string error;  ///< one line that begins with the name, and says who holds it if anybody does
};
/// Reads and writes do not block. Nobody else can open or lock it.
OpenedPort open_exclusively(const std::string& path, const std::string& name);
/// The same without holding it.
OpenedPort open_unheld(const std::string& path, const std::string& name);
/// "minicom (process 1234) holds this port; end it first", of a port that is locked by another program.
std::string held_by_another(const std::string& name, const std::string& path);
/// "minicom (process 1234)"; empty if it is none that we may look into.
std::string holder_of(const std::string& path);

/// 8N1 without handshake; a read returns what there is.
/// 11h and 13h are bytes as others: cfmakeraw leaves IXOFF and IXANY as they were.
inline constexpr tcflag_t kFlowControl = IXON | IXOFF | IXANY;
termios raw_mode(termios mode, speed_t speed);

}  // namespace nplc::hal_linux
