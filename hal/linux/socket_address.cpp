#include "socket_address.h"

#include "host/loopback.h"

namespace nplc::hal_linux {

std::optional<sockaddr_in> tcp_address(const std::string& where) {
    const auto known = host::loopback_address(where);
    if (!known) return std::nullopt;
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(known->ip);
    address.sin_port = htons(known->port);
    return address;
}

std::optional<sockaddr_un> unix_address(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.size() >= sizeof address.sun_path) return std::nullopt;
    path.copy(address.sun_path, path.size());
    return address;
}

}  // namespace nplc::hal_linux
