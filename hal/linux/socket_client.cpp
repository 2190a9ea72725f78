#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <functional>
#include <memory>

#include "descriptor_client.h"
#include "host/endpoint.h"
#include "port_holder.h"
#include "socket_address.h"

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

/// The server's backlog is full: reported for a socket in the file system, no answer for TCP.
bool is_full(int reason) {
    return reason == EAGAIN || reason == ETIMEDOUT;
}

/// The program is not there, or not yet; one that was killed leaves its socket in the file system.
bool is_absent(int reason) {
    return reason == ECONNREFUSED || reason == ENOENT;
}

class SocketClient final : public DescriptorClient {
  public:
    SocketClient(FileDescriptor descriptor, std::string name, std::function<std::string()> other_client)
        : DescriptorClient(std::move(descriptor), std::move(name)), other_client_(std::move(other_client)) {}
    std::string other_client() const override { return other_client_(); }

  private:
    std::function<std::string()> other_client_;
};

/// Returns 0, or errno.
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

host::ByteClient::Opened open_unix_client(const std::string& path) {
    const std::string name = host::Endpoint::text(host::Endpoint::Kind::unix_socket, path);
    const auto address = unix_address(path);
    if (!address) return {nullptr, name + ": the path is too long for a socket; name a shorter one", true};
    FileDescriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    const int reason =
        socket ? join(socket.get(), reinterpret_cast<const sockaddr*>(&*address), sizeof *address) : errno;
    if (reason != 0)
        return {nullptr, cannot_connect(name, reason), false, is_full(reason), is_absent(reason)};
    return {std::make_unique<SocketClient>(std::move(socket), name, [path] { return client_of_unix(path); }),
            {}};
}

host::ByteClient::Opened open_tcp_client(const std::string& where) {
    const std::string name = host::Endpoint::text(host::Endpoint::Kind::tcp, where);
    const auto address = tcp_address(where);
    if (!address || address->sin_port == 0)
        return {nullptr, name + ": write tcp:127.0.0.1:PORT (this machine only), PORT 1..65535", true};
    FileDescriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    const int reason =
        socket ? join(socket.get(), reinterpret_cast<const sockaddr*>(&*address), sizeof *address) : errno;
    if (reason != 0)
        return {nullptr, cannot_connect(name, reason), false, is_full(reason), is_absent(reason)};
    const int on = 1;
    ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    const std::uint16_t port = ntohs(address->sin_port);
    return {std::make_unique<SocketClient>(std::move(socket), name, [port] { return client_of_tcp(port); }),
            {}};
}

}  // namespace nplc::hal_linux
