#include <winsock2.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "clients.h"
#include "host/clock.h"
#include "host/endpoint.h"
#include "host/loopback.h"
#include "text.h"

namespace nplc::hal_windows {
namespace {

constexpr base::Microseconds kConnectWait{3'000'000};
constexpr base::Microseconds kWriteWait{1'000'000};
constexpr int kMostBytes = 65'536;

/// For the whole program, until it ends.
bool start_sockets() {
    static const bool started = [] {
        WSADATA about{};
        return ::WSAStartup(MAKEWORD(2, 2), &about) == 0;
    }();
    return started;
}

class Socket {
  public:
    explicit Socket(SOCKET socket) : socket_(socket) {}
    Socket(Socket&& other) noexcept : socket_(std::exchange(other.socket_, INVALID_SOCKET)) {}
    Socket& operator=(Socket&&) = delete;
    ~Socket() {
        if (socket_ != INVALID_SOCKET) ::closesocket(socket_);
    }
    SOCKET get() const { return socket_; }
    explicit operator bool() const { return socket_ != INVALID_SOCKET; }

  private:
    SOCKET socket_;
};

timeval limit_of(base::Microseconds wait) {
    const std::int64_t count = std::max<std::int64_t>(wait.count(), 0);
    timeval limit{};
    limit.tv_sec = static_cast<long>(count / 1'000'000);
    limit.tv_usec = static_cast<long>(count % 1'000'000);
    return limit;
}

fd_set only(SOCKET socket) {
    fd_set set{};
    set.fd_count = 1;
    set.fd_array[0] = socket;
    return set;
}

bool readable_within(SOCKET socket, base::Microseconds wait) {
    fd_set set = only(socket);
    timeval limit = limit_of(wait);
    return ::select(0, &set, nullptr, nullptr, &limit) > 0;
}

/// Windows reports a failed connection as an exception event.
bool writable_within(SOCKET socket, base::Microseconds wait) {
    fd_set set = only(socket);
    fd_set failed = only(socket);
    timeval limit = limit_of(wait);
    return ::select(0, nullptr, &set, &failed, &limit) > 0;
}

class SocketClient final : public host::ByteClient {
  public:
    SocketClient(Socket socket, std::string name) : socket_(std::move(socket)), name_(std::move(name)) {}

    const std::string& name() const override { return name_; }

    bool write(std::span<const std::uint8_t> bytes) override {
        while (!bytes.empty()) {
            const int part = static_cast<int>(std::min<std::size_t>(bytes.size(), kMostBytes));
            const int taken = ::send(socket_.get(), reinterpret_cast<const char*>(bytes.data()), part, 0);
            if (taken > 0) {
                bytes = bytes.subspan(static_cast<std::size_t>(taken));
                continue;
            }
            if (::WSAGetLastError() != WSAEWOULDBLOCK || !writable_within(socket_.get(), kWriteWait))
                return false;
        }
        return true;
    }

    std::optional<std::size_t> read(std::span<std::uint8_t> out, base::Microseconds wait) override {
        if (!readable_within(socket_.get(), wait)) return 0;
        const int room = static_cast<int>(std::min<std::size_t>(out.size(), kMostBytes));
        const int got = ::recv(socket_.get(), reinterpret_cast<char*>(out.data()), room, 0);
        if (got > 0) return static_cast<std::size_t>(got);
        if (got < 0 && ::WSAGetLastError() == WSAEWOULDBLOCK) return 0;
        return std::nullopt;
    }

    base::Instant now() const override { return host::steady_now(); }

  private:
    Socket socket_;
    std::string name_;
};

/// Returns 0, or the error number.
int join(SOCKET socket, const sockaddr_in& address) {
    u_long on = 1;
    if (::ioctlsocket(socket, static_cast<long>(FIONBIO), &on) != 0) return ::WSAGetLastError();
    if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return 0;
    if (::WSAGetLastError() != WSAEWOULDBLOCK) return ::WSAGetLastError();
    if (!writable_within(socket, kConnectWait)) return WSAETIMEDOUT;
    int reason = 0;
    int length = sizeof reason;
    ::getsockopt(socket, SOL_SOCKET, SO_ERROR, reinterpret_cast<char*>(&reason), &length);
    return reason;
}

std::string cannot_connect(const std::string& name, int reason) {
    if (reason == WSAECONNREFUSED || reason == WSAETIMEDOUT)
        return name + ": nobody listens there; is the program running?";
    return name + ": cannot be connected: " + error_text(static_cast<unsigned long>(reason));
}

}  // namespace

host::ByteClient::Opened open_tcp_client(const std::string& where) {
    const std::string name = host::Endpoint::text(host::Endpoint::Kind::tcp, where);
    const auto known = host::loopback_address(where);
    if (!known || known->port == 0)
        return {nullptr, name + ": write tcp:127.0.0.1:PORT (this machine only), PORT 1..65535", true};
    if (!start_sockets()) return {nullptr, name + ": Windows' sockets cannot be used"};
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = ::htonl(known->ip);
    address.sin_port = ::htons(known->port);
    Socket socket(::socket(AF_INET, SOCK_STREAM, IPPROTO_TCP));
    const int reason = socket ? join(socket.get(), address) : ::WSAGetLastError();
    const bool is_absent = reason == WSAECONNREFUSED || reason == WSAETIMEDOUT;
    if (reason != 0) return {nullptr, cannot_connect(name, reason), false, false, is_absent};
    const int on = 1;
    ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, reinterpret_cast<const char*>(&on), sizeof on);
    return {std::make_unique<SocketClient>(std::move(socket), name), {}};
}

}  // namespace nplc::hal_windows
