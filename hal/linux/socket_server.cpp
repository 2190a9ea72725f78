#include "socket_server.h"

#include <poll.h>
#include <sys/epoll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <vector>

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
    /// `is_tcp`: what its clients say first is looked at.
    SocketServer(ListeningSocket listener, std::size_t seats, bool is_tcp)
        : listener_(std::move(listener)), guests_(seats), is_tcp_(is_tcp) {
        watch(listener_.descriptor.get());
    }

    const std::string& name() const override { return listener_.name; }

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
        while (has_event(listener_.descriptor, POLLIN)) {
            Guest* seat = seat_for_newcomer();
            if (seat == nullptr && waits_for_last_words()) return;
            FileDescriptor next = accept_client(listener_.descriptor);
            if (!next) return;
            if (seat == nullptr) continue;  // turned away
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
    ListeningSocket listener_;
    std::vector<Guest> guests_;
    std::uint64_t visitors_ = 0;
    std::uint64_t messages_ = 0;
    bool is_tcp_;
};

ByteServer::Opened serve(ListeningSocket listener, std::size_t seats, bool is_tcp) {
    if (!listener.error.empty()) return {nullptr, listener.error};
    return {std::make_unique<SocketServer>(std::move(listener), seats, is_tcp), {}};
}

}  // namespace

ByteServer::Opened open_unix_server(const std::string& path, const ByteServer::Settings& settings) {
    return serve(listen_at_path(path, settings), settings.seats, false);
}

ByteServer::Opened open_tcp_server(const std::string& where, std::size_t seats) {
    return serve(listen_at_port(where), seats, true);
}

}  // namespace nplc::hal_linux
