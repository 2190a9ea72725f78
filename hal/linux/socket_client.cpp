#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cerrno>
#include <cstring>
#include <memory>

#include "descriptor_client.h"

namespace nplc::hal_linux {
namespace {

constexpr int kConnectWaitMs = 3000;

std::string cannot_connect(const std::string& name, int reason) {
    switch (reason) {
        case ECONNREFUSED:
            return name + ": nobody listens there; is the program running?";
        case ENOENT:
            return name + ": there is no such socket; is the program running?";
        default:
            return name + ": cannot be connected: " + std::strerror(reason);
    }
}

/// 0, or the reason.
int join(int socket, const sockaddr* address, socklen_t size) {
    if (::connect(socket, address, size) == 0) return 0;
    if (errno != EINPROGRESS) return errno;
    pollfd state{.fd = socket, .events = POLLOUT, .revents = 0};
    if (::poll(&state, 1, kConnectWaitMs) <= 0) return ETIMEDOUT;
    int reason = 0;
    socklen_t length = sizeof reason;
    ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &reason, &length);
    return reason;
}

}  // namespace

ByteClient::Opened open_unix_client(const std::string& path) {
    const std::string name = "unix:" + path;
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.size() >= sizeof address.sun_path)
        return {nullptr, name + ": the path is too long for a socket; name a shorter one"};
    path.copy(address.sun_path, path.size());
    FileDescriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    const int reason =
        socket ? join(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) : errno;
    if (reason != 0) return {nullptr, cannot_connect(name, reason)};
    return {std::make_unique<DescriptorClient>(std::move(socket), name), {}};
}

ByteClient::Opened open_tcp_client(const std::string& where) {
    const std::string name = "tcp:" + where;
    const auto colon = where.rfind(':');
    if (colon == std::string::npos || colon == 0 || colon + 1 == where.size())
        return {nullptr, name + ": write tcp:HOST:PORT"};
    addrinfo hints{};
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    const int trouble =
        ::getaddrinfo(where.substr(0, colon).c_str(), where.substr(colon + 1).c_str(), &hints, &found);
    if (trouble != 0) return {nullptr, name + ": " + ::gai_strerror(trouble)};
    const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> all(found, ::freeaddrinfo);
    int reason = ECONNREFUSED;
    for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
        FileDescriptor socket(::socket(one->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
        reason = socket ? join(socket.get(), one->ai_addr, one->ai_addrlen) : errno;
        if (reason != 0) continue;
        const int on = 1;
        ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        return {std::make_unique<DescriptorClient>(std::move(socket), name), {}};
    }
    return {nullptr, cannot_connect(name, reason)};
}

}  // namespace nplc::hal_linux
