#include "socket_server.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

#include "file_descriptor.h"
#include "socket_address.h"

namespace nplc::hal_linux {
namespace {

std::string reason() {
    return std::strerror(errno);
}

/// Of a socket in the file system, which is removed with it.
class BoundPath {
  public:
    explicit BoundPath(std::string path) : path_(std::move(path)) {}
    BoundPath(BoundPath&& other) noexcept : path_(std::exchange(other.path_, {})) {}
    BoundPath& operator=(BoundPath&&) = delete;
    ~BoundPath() {
        if (!path_.empty()) ::unlink(path_.c_str());
    }

  private:
    std::string path_;
};

class SocketServer final : public ByteServer {
  public:
    SocketServer(FileDescriptor listener, std::string name, BoundPath path, std::size_t seats)
        : listener_(std::move(listener)),
          clients_(seats),
          visits_(seats),
          path_(std::move(path)),
          name_(std::move(name)) {
        watch(listener_.get());
    }

    const std::string& name() const override { return name_; }

    bool has_client() override {
        accept_clients();
        return std::any_of(clients_.begin(), clients_.end(),
                           [](const FileDescriptor& client) { return static_cast<bool>(client); });
    }
    std::size_t seats() const override { return clients_.size(); }
    std::uint64_t visit(std::size_t seat) override {
        accept_clients();
        return clients_[seat] ? visits_[seat] : 0;
    }

    std::size_t read_seat(std::size_t seat, std::span<std::uint8_t> out) override {
        accept_clients();
        FileDescriptor& client = clients_[seat];
        if (!client || out.empty()) return 0;
        const ssize_t count = ::recv(client.get(), out.data(), out.size(), 0);
        if (count > 0) return static_cast<std::size_t>(count);
        if (count == 0 || (errno != EAGAIN && errno != EINTR)) client.close();
        return 0;
    }

    void write_seat(std::size_t seat, std::span<const std::uint8_t> bytes) override {
        accept_clients();
        FileDescriptor& client = clients_[seat];
        if (!client) return;
        const ssize_t taken = ::send(client.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (taken < 0 && errno != EAGAIN && errno != EINTR) client.close();
    }

    int descriptor() const override { return all_.get(); }

  private:
    void watch(int descriptor) {
        epoll_event event{.events = EPOLLIN | EPOLLRDHUP, .data = {.fd = descriptor}};
        ::epoll_ctl(all_.get(), EPOLL_CTL_ADD, descriptor, &event);
    }

    void accept_clients() {
        while (has_event(listener_, POLLIN)) {
            const auto seat = std::find_if(clients_.begin(), clients_.end(), is_free);
            const bool full = seat == clients_.end();
            if (full && std::any_of(clients_.begin(), clients_.end(), hung_up))
                return;  // its last words come first
            FileDescriptor next(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
            if (!next) return;
            if (full) continue;  // turned away
            const int on = 1;
            ::setsockopt(next.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
            watch(next.get());
            *seat = std::move(next);
            visits_[static_cast<std::size_t>(seat - clients_.begin())] = ++visitors_;
        }
    }

    static bool has_event(const FileDescriptor& descriptor, short events) {
        pollfd state{.fd = descriptor.get(), .events = events, .revents = 0};
        return ::poll(&state, 1, 0) == 1;
    }
    static bool hung_up(const FileDescriptor& client) { return has_event(client, POLLRDHUP); }

    /// A client that hung up makes room at once, even if nobody has read since, but for what it still had to
    /// say.
    static bool is_free(const FileDescriptor& client) {
        char byte = 0;
        return !client || (hung_up(client) && ::recv(client.get(), &byte, 1, MSG_PEEK) <= 0);
    }

    FileDescriptor all_{::epoll_create1(EPOLL_CLOEXEC)};  ///< readable when one of the others is
    FileDescriptor listener_;
    std::vector<FileDescriptor> clients_;
    std::vector<std::uint64_t> visits_;  ///< of the client in each seat
    std::uint64_t visitors_ = 0;
    BoundPath path_;
    std::string name_;
};

FileDescriptor make_socket(int family) {
    return FileDescriptor(::socket(family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
}

template <class Address>
const sockaddr* generic(const Address& address) {
    return reinterpret_cast<const sockaddr*>(&address);
}

/// Left behind by a program that was killed: nobody listens there any more.
bool is_stale_socket(const std::string& path, const sockaddr_un& address) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0 || !S_ISSOCK(status.st_mode)) return false;
    const FileDescriptor probe = make_socket(AF_UNIX);
    return ::connect(probe.get(), generic(address), sizeof address) != 0 && errno == ECONNREFUSED;
}

std::string tcp_name(int listener) {
    sockaddr_in address{};
    socklen_t size = sizeof address;
    ::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size);
    char host[INET_ADDRSTRLEN] = {};
    ::inet_ntop(AF_INET, &address.sin_addr, host, sizeof host);
    return std::string("tcp:") + host + ":" + std::to_string(ntohs(address.sin_port));
}

}  // namespace

ByteServer::Opened open_unix_server(const std::string& path, std::size_t seats) {
    const std::string name = "unix:" + path;
    const auto address = unix_address(path);
    if (!address) return {nullptr, name + ": the path is too long for a socket; name a shorter one"};
    FileDescriptor listener = make_socket(AF_UNIX);
    if (!listener) return {nullptr, name + ": " + reason()};
    if (is_stale_socket(path, *address)) ::unlink(path.c_str());
    if (::bind(listener.get(), generic(*address), sizeof *address) != 0) {
        return {nullptr,
                name + ": " +
                    (errno == EADDRINUSE ? "there is a file of this name, or another program listens "
                                           "there; name another path"
                                         : reason())};
    }
    BoundPath bound(path);
    if (::listen(listener.get(), 1) != 0) return {nullptr, name + ": " + reason()};
    return {std::make_unique<SocketServer>(std::move(listener), name, std::move(bound), seats), {}};
}

ByteServer::Opened open_tcp_server(const std::string& where, std::size_t seats) {
    const auto address = tcp_address(where);
    if (!address)
        return {nullptr, "tcp:" + where + ": write tcp:127.0.0.1:PORT (this machine only), PORT 0..65535"};
    FileDescriptor listener = make_socket(AF_INET);
    const int on = 1;
    if (listener) ::setsockopt(listener.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    if (!listener || ::bind(listener.get(), generic(*address), sizeof *address) != 0 ||
        ::listen(listener.get(), 1) != 0) {
        return {nullptr, "tcp:" + where + ": " + reason()};
    }
    const std::string name = tcp_name(listener.get());
    return {std::make_unique<SocketServer>(std::move(listener), name, BoundPath(std::string()), seats), {}};
}

}  // namespace nplc::hal_linux
