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
#include "hal_linux/group.h"
#include "host/endpoint.h"
#include "name_lock.h"
#include "reason.h"
#include "socket_address.h"
#include "stream_opening.h"

namespace nplc::hal_linux {
namespace {

/// Of a socket in the file system, which is removed with it unless another one is there by then.
class BoundPath {
  public:
    BoundPath() = default;
    BoundPath(NameLock lock, std::string path) : lock_(std::move(lock)), path_(std::move(path)) {
        ::lstat(path_.c_str(), &bound_);
    }
    BoundPath(BoundPath&& other) noexcept
        : lock_(std::move(other.lock_)), path_(std::exchange(other.path_, {})), bound_(other.bound_) {}
    BoundPath& operator=(BoundPath&&) = delete;
    ~BoundPath() {
        struct stat there {};
        if (path_.empty() || ::lstat(path_.c_str(), &there) != 0) return;
        if (there.st_dev == bound_.st_dev && there.st_ino == bound_.st_ino) ::unlink(path_.c_str());
    }

  private:
    NameLock lock_;
    std::string path_;
    struct stat bound_ {};
};

bool has_event(const FileDescriptor& descriptor, short events) {
    pollfd state{.fd = descriptor.get(), .events = events, .revents = 0};
    return ::poll(&state, 1, 0) == 1;
}

class SocketServer final : public ByteServer {
  public:
    /// `is_tcp`: what its clients say first is looked at.
    SocketServer(FileDescriptor listener, std::string name, BoundPath path, std::size_t seats, bool is_tcp)
        : listener_(std::move(listener)),
          guests_(seats),
          path_(std::move(path)),
          name_(std::move(name)),
          is_tcp_(is_tcp) {
        watch(listener_.get());
    }

    const std::string& name() const override { return name_; }

    bool has_client() override {
        accept_clients();
        return std::any_of(guests_.begin(), guests_.end(),
                           [](const Guest& guest) { return static_cast<bool>(guest.socket); });
    }
    std::size_t seats() const override { return guests_.size(); }
    std::uint64_t visit(std::size_t seat) override {
        if (guests_.size() == 1) accept_clients();
        return guests_[seat].socket ? guests_[seat].visit : 0;
    }
    bool has_left(std::size_t seat) override {
        const Guest& guest = guests_[seat];
        return !guest.socket || hung_up(guest);
    }
    void note_message(std::size_t seat) override { guests_[seat].heard = ++messages_; }

    std::size_t read_seat(std::size_t seat, std::span<std::uint8_t> out) override {
        if (guests_.size() == 1) accept_clients();
        Guest& guest = guests_[seat];
        if (!guest.socket || out.empty()) return 0;
        const ssize_t count = ::recv(guest.socket.get(), out.data(), out.size(), 0);
        if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) guest.socket.close();
        if (count <= 0) return 0;
        if (is_tcp_ && !guest.opening.admits(out.first(static_cast<std::size_t>(count)))) {
            guest.socket.close();
            return 0;
        }
        return static_cast<std::size_t>(count);
    }

    void write_seat(std::size_t seat, std::span<const std::uint8_t> bytes) override {
        if (guests_.size() == 1) accept_clients();
        Guest& guest = guests_[seat];
        if (!guest.socket) return;
        const ssize_t taken = ::send(guest.socket.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (taken < 0 && errno != EAGAIN && errno != EINTR) guest.socket.close();
    }

    int descriptor() const override { return all_.get(); }

  private:
    struct Guest {
        FileDescriptor socket;
        std::uint64_t visit = 0;  ///< another number for each client
        std::uint64_t heard = 0;  ///< rises with every message of any client; 0: none yet
        StreamOpening opening;
    };

    void watch(int descriptor) {
        epoll_event event{.events = EPOLLIN | EPOLLRDHUP, .data = {.fd = descriptor}};
        ::epoll_ctl(all_.get(), EPOLL_CTL_ADD, descriptor, &event);
    }

    void accept_clients() {
        while (has_event(listener_, POLLIN)) {
            Guest* seat = seat_for_newcomer();
            if (seat == nullptr && waits_for_last_words()) return;
            FileDescriptor next(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
            if (!next) return;
            if (seat == nullptr) continue;  // turned away
            const int on = 1;
            ::setsockopt(next.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
            watch(next.get());
            *seat = {std::move(next), ++visitors_, 0, {}};
        }
    }

    /// A free one; else, of several, that of the client whose last message is the longest ago. What was sent
    /// is read before its sender loses its seat.
    Guest* seat_for_newcomer() {
        const auto free = std::find_if(guests_.begin(), guests_.end(), is_free);
        if (free != guests_.end()) return &*free;
        Guest* oldest = nullptr;
        for (Guest& guest : guests_) {
            if (guests_.size() == 1 || has_event(guest.socket, POLLIN)) continue;
            if (oldest == nullptr ||
                std::pair(guest.heard, guest.visit) < std::pair(oldest->heard, oldest->visit))
                oldest = &guest;
        }
        return oldest;
    }
    bool waits_for_last_words() const {
        return guests_.size() > 1 || std::any_of(guests_.begin(), guests_.end(), hung_up);
    }

    static bool hung_up(const Guest& guest) { return has_event(guest.socket, POLLRDHUP); }

    /// A client that hung up makes room at once, even if nobody has read since, but for what it still had to
    /// say.
    static bool is_free(const Guest& guest) {
        char byte = 0;
        return !guest.socket || (hung_up(guest) && ::recv(guest.socket.get(), &byte, 1, MSG_PEEK) <= 0);
    }

    FileDescriptor all_{::epoll_create1(EPOLL_CLOEXEC)};  ///< readable when one of the others is
    FileDescriptor listener_;
    std::vector<Guest> guests_;
    std::uint64_t visitors_ = 0;
    std::uint64_t messages_ = 0;
    BoundPath path_;
    std::string name_;
    bool is_tcp_;
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

/// Empty, or what is wrong.
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

}  // namespace

ByteServer::Opened open_unix_server(const std::string& path, const ByteServer::Settings& settings) {
    const std::string name = host::Endpoint::text(host::Endpoint::Kind::unix_socket, path);
    const auto address = unix_address(path);
    if (!address) return {nullptr, name + ": the path is too long for a socket; name a shorter one"};
    auto [lock, taken] = NameLock::take(name, path, settings.at_once);
    if (!taken.empty()) return {nullptr, taken};
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
    BoundPath bound(std::move(lock), path);
    // Nobody can connect before it listens.
    if (const std::string error = set_access(path, settings); !error.empty())
        return {nullptr, name + ": " + error};
    if (::listen(listener.get(), SOMAXCONN) != 0) return {nullptr, name + ": " + reason()};
    return {
        std::make_unique<SocketServer>(std::move(listener), name, std::move(bound), settings.seats, false),
        {}};
}

ByteServer::Opened open_tcp_server(const std::string& where, std::size_t seats) {
    const std::string asked = host::Endpoint::text(host::Endpoint::Kind::tcp, where);
    const auto address = tcp_address(where);
    if (!address) return {nullptr, asked + ": write tcp:127.0.0.1:PORT (this machine only), PORT 0..65535"};
    FileDescriptor listener = make_socket(AF_INET);
    const int on = 1;
    if (listener) ::setsockopt(listener.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    if (!listener || ::bind(listener.get(), generic(*address), sizeof *address) != 0 ||
        ::listen(listener.get(), SOMAXCONN) != 0) {
        return {nullptr, asked + ": " + reason()};
    }
    const std::string name = tcp_name(listener.get());
    return {std::make_unique<SocketServer>(std::move(listener), name, BoundPath(), seats, true), {}};
}

}  // namespace nplc::hal_linux
