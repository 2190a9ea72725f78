#include "hal_linux/tcp_listener.h"

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>

namespace nplc::hal_linux {
namespace {

constexpr int kBacklog = 16;

struct Place {
    std::string host;
    std::string port;
};

std::optional<Place> place_of(const std::string& where) {
    const std::string prefix = "tcp:";
    const std::size_t colon = where.rfind(':');
    if (!where.starts_with(prefix) || colon <= prefix.size()) return std::nullopt;
    Place place{where.substr(prefix.size(), colon - prefix.size()), where.substr(colon + 1)};
    if (place.host.starts_with('[') && place.host.ends_with(']'))
        place.host = place.host.substr(1, place.host.size() - 2);
    const bool is_number = !place.port.empty() && place.port.size() <= 5 &&
                           place.port.find_first_not_of("0123456789") == std::string::npos &&
                           std::stoul(place.port) <= 65535;
    if (place.host.empty() || !is_number) return std::nullopt;
    return place;
}

struct AddressList {
    addrinfo* first = nullptr;
    ~AddressList() {
        if (first != nullptr) ::freeaddrinfo(first);
    }
};

int look_up(const Place& place, AddressList& list) {
    addrinfo hints{};
    hints.ai_flags = AI_PASSIVE | AI_NUMERICHOST | AI_NUMERICSERV;
    hints.ai_socktype = SOCK_STREAM;
    return ::getaddrinfo(place.host.c_str(), place.port.c_str(), &hints, &list.first);
}

std::uint16_t port_of(int descriptor) {
    sockaddr_storage address{};
    socklen_t size = sizeof address;
    if (::getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
    const auto* four = reinterpret_cast<const sockaddr_in*>(&address);
    const auto* six = reinterpret_cast<const sockaddr_in6*>(&address);
    return ntohs(address.ss_family == AF_INET6 ? six->sin6_port : four->sin_port);
}

}  // namespace

std::string listen_remedy(int error) {
    switch (error) {
        case EACCES:
            return "a port below 1024 needs the right to it; write one above 1023, or for the package's "
                   "service `systemctl edit nanoplc` with [Service], "
                   "AmbientCapabilities=CAP_NET_BIND_SERVICE and "
                   "CapabilityBoundingSet=CAP_NET_BIND_SERVICE";
        case EADDRINUSE:
            return "another program listens there, and `ss -ltnp` as root names it; end it, or write another "
                   "port";
        case EADDRNOTAVAIL:
            return "this machine has no such address now; write one that `ip -br address` lists, or 0.0.0.0 "
                   "for all";
        case EAFNOSUPPORT:
            return "this machine does not have this kind of address; write one of IPv4";
        default:
            return "write another address or port";
    }
}

bool is_privileged(unsigned port) {
    unsigned first = 1024;
    std::ifstream("/proc/sys/net/ipv4/ip_unprivileged_port_start") >> first;
    return port != 0 && port < first;
}

TcpListener::~TcpListener() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

std::string TcpListener::mistake_in(const std::string& where) {
    const auto place = place_of(where);
    if (!place) return "is no place to listen; write such as \"tcp:127.0.0.1:502\" or \"tcp:[::]:502\"";
    AddressList list;
    if (look_up(*place, list) != 0)
        return fmt::format("{} is no address of IPv4 or IPv6; a name is not looked up", place->host);
    return {};
}

unsigned TcpListener::port_in(const std::string& where) {
    const std::string port = where.substr(where.rfind(':') + 1);
    const bool is_number =
        !port.empty() && port.size() <= 5 && port.find_first_not_of("0123456789") == std::string::npos;
    return is_number ? static_cast<unsigned>(std::stoul(port)) : 0;
}

bool TcpListener::has_address(const std::string& where) {
    AddressList list;
    const auto place = place_of(where);
    if (!place || look_up({.host = place->host, .port = "0"}, list) != 0) return false;
    const int descriptor = ::socket(list.first->ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (descriptor < 0) return false;
    const bool is_bound = ::bind(descriptor, list.first->ai_addr, list.first->ai_addrlen) == 0;
    const int cause = errno;
    ::close(descriptor);
    return is_bound || cause != EADDRNOTAVAIL;
}

std::string TcpListener::open(const std::string& where) {
    const Place place = place_of(where).value_or(Place{});
    AddressList list;
    if (place.host.empty() || look_up(place, list) != 0)
        return fmt::format("{} {}", where, mistake_in(where));
    const auto fail = [&where](const char* what) {
        const int cause = errno;
        return fmt::format("{}: {}: {}; {}", where, what, std::strerror(cause), listen_remedy(cause));
    };
    descriptor_ = ::socket(list.first->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (descriptor_ < 0) return fail("no socket");
    const int on = 1;
    ::setsockopt(descriptor_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    if (::bind(descriptor_, list.first->ai_addr, list.first->ai_addrlen) != 0) return fail("cannot be had");
    if (::listen(descriptor_, kBacklog) != 0) return fail("cannot listen");
    name_ = fmt::format("{}:{}", where.substr(0, where.rfind(':')), port_of(descriptor_));
    return {};
}

TcpListener::Client TcpListener::accept() const {
    sockaddr_storage address{};
    socklen_t size = sizeof address;
    Client client;
    client.descriptor =
        ::accept4(descriptor_, reinterpret_cast<sockaddr*>(&address), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (client.descriptor < 0) return client;
    const int on = 1;
    ::setsockopt(client.descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    char host[NI_MAXHOST] = "";
    ::getnameinfo(reinterpret_cast<const sockaddr*>(&address), size, host, sizeof host, nullptr, 0,
                  NI_NUMERICHOST);
    client.peer = host;
    return client;
}

}  // namespace nplc::hal_linux
