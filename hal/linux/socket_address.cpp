#include "socket_address.h"

#include <arpa/inet.h>

#include <charconv>
#include <cstdint>

namespace nplc::hal_linux {
namespace {

bool is_loopback(const sockaddr_in& address) {
    return ntohl(address.sin_addr.s_addr) >> 24 == IN_LOOPBACKNET;
}

}  // namespace

std::optional<sockaddr_in> tcp_address(const std::string& where) {
    const auto colon = where.rfind(':');
    if (colon == std::string::npos) return std::nullopt;
    const std::string host = where.substr(0, colon) == "localhost" ? "127.0.0.1" : where.substr(0, colon);
    const std::string digits = where.substr(colon + 1);
    std::uint16_t port = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    const bool sound = error == std::errc() && end == digits.data() + digits.size() && !digits.empty() &&
                       ::inet_pton(AF_INET, host.c_str(), &address.sin_addr) == 1;
    return sound && is_loopback(address) ? std::optional(address) : std::nullopt;
}

std::optional<sockaddr_un> unix_address(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.size() >= sizeof address.sun_path) return std::nullopt;
    path.copy(address.sun_path, path.size());
    return address;
}

}  // namespace nplc::hal_linux
