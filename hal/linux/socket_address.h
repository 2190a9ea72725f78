#pragma once

#include <netinet/in.h>
#include <sys/un.h>

#include <optional>
#include <string>

namespace nplc::hal_linux {

/// HOST:PORT of this machine only, HOST 127.x.x.x or localhost, PORT 0..65535; nothing for any other. These
/// lines know no password: nobody outside of this machine may move a motor.
std::optional<sockaddr_in> tcp_address(const std::string& where);

/// Nothing for a path that is too long for a socket.
std::optional<sockaddr_un> unix_address(const std::string& path);

}  // namespace nplc::hal_linux
