#include "socket_server.h"

#include <poll.h>
#include <sys/epoll.h>
#include <sys/socket.h>

#include <cerrno>

#include "file_descriptor.h"
#include "listening_socket.h"
#include "stream_opening.h"

namespace nplc::hal_linux {
namespace {

bool has_event(const FileDescriptor& descriptor, short events) {
    pollfd state{.fd = descriptor.get(), .events = events, .revents = 0};
    return ::poll(&state, 1, 0) == 1;
}

class SocketServer final : public ByteServer {
  public:
    /// `is_tcp`: the client's first bytes are checked.
    SocketServer(ListeningSocket listener, bool is_tcp) : listener_(std::move(listener)), is_tcp_(is_tcp) {
        watch(listener_.descriptor.get());
    }

    const std::string& name() const override { return listener_.name; }

    bool has_client() override {
        accept_clients();
        return static_cast<bool>(client_);
    }

    std::size_t read(std::span<std::uint8_t> out) override {
        accept_clients();
        if (!client_ || out.empty()) return 0;
        const ssize_t count = ::recv(client_.get(), out.data(), out.size(), 0);
        if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) client_.close();
        if (count <= 0) return 0;
        if (is_tcp_ && !opening_.admits(out.first(static_cast<std::size_t>(count)))) {
            client_.close();
            return 0;
        }
        return static_cast<std::size_t>(count);
    }

    void write(std::span<const std::uint8_t> bytes) override {
        accept_clients();
        if (!client_) return;
        const ssize_t taken = ::send(client_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (taken < 0 && errno != EAGAIN && errno != EINTR) client_.close();
    }

    int descriptor() const override { return all_.get(); }

  private:
    void watch(int descriptor) {
        epoll_event event{.events = EPOLLIN | EPOLLRDHUP, .data = {.fd = descriptor}};
        ::epoll_ctl(all_.get(), EPOLL_CTL_ADD, descriptor, &event);
    }

    /// A second client is rejected; it waits while the first has hung up and is not read to its end.
    void accept_clients() {
        while (has_event(listener_.descriptor, POLLIN)) {
            const bool has_room = !client_ || (has_hung_up() && !has_unread());
            if (!has_room && has_hung_up()) return;
            FileDescriptor next = accept_client(listener_.descriptor);
            if (!next) return;
            if (!has_room) continue;
            watch(next.get());
            client_ = std::move(next);
            opening_ = {};
        }
    }

    bool has_hung_up() const { return has_event(client_, POLLRDHUP); }
    bool has_unread() const {
        char byte = 0;
        return ::recv(client_.get(), &byte, 1, MSG_PEEK) > 0;
    }

    FileDescriptor all_{::epoll_create1(EPOLL_CLOEXEC)};  ///< readable when one of the others is
    ListeningSocket listener_;
    FileDescriptor client_;
    StreamOpening opening_;  ///< of the client
    bool is_tcp_;
};

ByteServer::Opened serve(ListeningSocket listener, bool is_tcp) {
    if (!listener.error.empty()) return {nullptr, listener.error};
    return {std::make_unique<SocketServer>(std::move(listener), is_tcp), {}};
}

}  // namespace

ByteServer::Opened open_unix_server(const std::string& path, const ByteServer::Settings& settings) {
    return serve(listen_at_path(path, settings), false);
}

ByteServer::Opened open_tcp_server(const std::string& where) {
    return serve(listen_at_port(where), true);
}

}  // namespace nplc::hal_linux
