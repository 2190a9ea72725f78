#pragma once

#include <netinet/in.h>
#include <sys/un.h>

#include <optional>
#include <string>

namespace nplc::hal_linux {

/// Nothing for what is no host::loopback_address.
std::optional<sockaddr_in> tcp_address(const std::string& where);

/// Nothing for a path that is too long for a socket.
std::optional<sockaddr_un> unix_address(const std::string& path);

}  // namespace nplc::hal_linux
