#include "listening_socket.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cerrno>

#include "hal_linux/group.h"
#include "hal_linux/tcp_listener.h"
#include "host/endpoint.h"
#include "reason.h"
#include "socket_address.h"

namespace nplc::hal_linux {
namespace {

FileDescriptor make_socket(int family) {
    return FileDescriptor(::socket(family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
}

template <class Address>
const sockaddr* generic(const Address& address) {
    return reinterpret_cast<const sockaddr*>(&address);
}

/// Left by a killed program: there is no server any more.
bool is_stale_socket(const std::string& path, const sockaddr_un& address) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0 || !S_ISSOCK(status.st_mode)) return false;
    const FileDescriptor probe = make_socket(AF_UNIX);
    return ::connect(probe.get(), generic(address), sizeof address) != 0 && errno == ECONNREFUSED;
}

/// Empty, or an error.
std::string set_access(const std::string& path, const ByteServer::Settings& settings) {
    if (!settings.group.empty()) {
        const auto group = group_number(settings.group);
        if (!group) return "there is no group " + settings.group + "; name one of this system";
        if (::chown(path.c_str(), static_cast<uid_t>(-1), *group) != 0)
            return "it cannot be given to group " + settings.group + ": " + reason() +
                   "; the program's user must be a member of it";
    }
    if (::chmod(path.c_str(), settings.mode) != 0) return "its mode cannot be set: " + reason();
    return {};
}

std::string tcp_name(int listener) {
    sockaddr_in address{};
    socklen_t size = sizeof address;
    ::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
    char text[INET_ADDRSTRLEN] = {};
    ::inet_ntop(AF_INET, &address.sin_addr, text, sizeof text);
    return host::Endpoint::text(host::Endpoint::Kind::tcp,
                                std::string(text) + ":" + std::to_string(ntohs(address.sin_port)));
}

ListeningSocket failed(std::string error) {
    return {.error = std::move(error)};
}

}  // namespace

ListeningSocket listen_at_path(const std::string& path, const ByteServer::Settings& settings) {
    const std::string name = host::Endpoint::text(host::Endpoint::Kind::unix_socket, path);
    const auto address = unix_address(path);
    if (!address) return failed(name + ": the path is too long for a socket; name a shorter one");
    auto [lock, taken] = NameLock::take(name, path, settings.at_once);
    if (!taken.empty()) return failed(taken);
    FileDescriptor listener = make_socket(AF_UNIX);
    if (!listener) return failed(name + ": " + reason());
    if (is_stale_socket(path, *address)) ::unlink(path.c_str());
    if (::bind(listener.get(), generic(*address), sizeof *address) != 0) {
        const bool is_taken = errno == EADDRINUSE;
        return failed(name + ": " +
                      (is_taken ? "there is a file of this name, or another program listens there; name "
                                  "another path"
                                : reason()));
    }
    BoundPath bound(std::move(lock), path);
    // No client can connect before listen().
    if (const std::string error = set_access(path, settings); !error.empty())
        return failed(name + ": " + error);
    if (::listen(listener.get(), SOMAXCONN) != 0) return failed(name + ": " + reason());
    return {std::move(listener), name, std::move(bound), {}};
}

ListeningSocket listen_at_port(const std::string& where) {
    const std::string asked = host::Endpoint::text(host::Endpoint::Kind::tcp, where);
    const auto address = tcp_address(where);
    if (!address) return failed(asked + ": write tcp:127.0.0.1:PORT (this machine only), PORT 0..65535");
    FileDescriptor listener = make_socket(AF_INET);
    const int on = 1;
    if (listener) ::setsockopt(listener.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    if (!listener || ::bind(listener.get(), generic(*address), sizeof *address) != 0 ||
        ::listen(listener.get(), SOMAXCONN) != 0) {
        const int cause = errno;
        return failed(fmt::format("{}: {}; {}", asked, std::strerror(cause), listen_remedy(cause)));
    }
    const std::string name = tcp_name(listener.get());
    return {std::move(listener), name, BoundPath(), {}};
}

FileDescriptor accept_client(const FileDescriptor& listener) {
    FileDescriptor client(::accept4(listener.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!client) return client;
    const int on = 1;
    ::setsockopt(client.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    return client;
}

}  // namespace nplc::hal_linux
