#pragma once

#include <netinet/in.h>
#include <sys/un.h>

#include <optional>
#include <string>

namespace nplc::hal_linux {

/// Empty if it is not a host::loopback_address.
std::optional<sockaddr_in> tcp_address(const std::string& where);

/// Empty if the path is too long for a socket.
std::optional<sockaddr_un> unix_address(const std::string& path);

}  // namespace nplc::hal_linux
