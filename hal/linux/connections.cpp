#include "hal_linux/connections.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/epoll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <map>
#include <utility>

#include "host/endpoint.h"
#include "listening_socket.h"
#include "stream_opening.h"

namespace nplc::hal_linux {
namespace {

class SocketConnections final : public Connections {
  public:
    /// `is_tcp`: the first bytes of clients are checked.
    SocketConnections(ListeningSocket listener, bool is_tcp)
        : listener_(std::move(listener)), is_tcp_(is_tcp) {
        control(EPOLL_CTL_ADD, listener_.descriptor.get(), 0, EPOLLIN);
    }

    const std::string& name() const override { return listener_.name; }
    int descriptor() const override { return all_.get(); }
    unsigned turned_away() const override { return turned_away_; }

    std::optional<Id> accept() override {
        FileDescriptor socket = accept_client(listener_.descriptor);
        lacks_room_ = !socket && (errno == EMFILE || errno == ENFILE);
        if (!socket) return std::nullopt;
        const Id id = ++last_;
        control(EPOLL_CTL_ADD, socket.get(), id, EPOLLIN | EPOLLRDHUP);
        clients_[id].socket = std::move(socket);
        return id;
    }

    bool lacks_room() const override { return lacks_room_; }
    Peer peer(Id id) const override {
        const auto client = clients_.find(id);
        return client == clients_.end() ? Peer{} : peer_of(client->second.socket.get());
    }

    std::vector<Id> with_news() override {
        std::array<epoll_event, 512> events;
        const int count = ::epoll_wait(all_.get(), events.data(), static_cast<int>(events.size()), 0);
        std::vector<Id> news;
        for (const auto& [id, client] : clients_) {
            if (!client.is_listened_to && !client.has_ended) news.push_back(id);
        }
        for (int i = 0; i < count; ++i) {
            const Id id = events[static_cast<std::size_t>(i)].data.u64;
            const auto client = clients_.find(id);
            if (client != clients_.end() && (client->second.is_listened_to || client->second.has_ended))
                news.push_back(id);
        }
        return news;
    }

    Got read(Id id, std::span<std::uint8_t> out) override {
        const auto client = clients_.find(id);
        if (client == clients_.end()) return {0, State::gone};
        const ssize_t count = ::recv(client->second.socket.get(), out.data(), out.size(), 0);
        const bool is_broken = count < 0 && errno != EAGAIN && errno != EINTR;
        const auto bytes = static_cast<std::size_t>(std::max<ssize_t>(count, 0));
        if (is_tcp_ && !client->second.opening.admits(out.first(bytes))) {
            ++turned_away_;
            return lose(id);
        }
        const short hung_up = hang_up(client->second.socket);
        if (is_broken || (count == 0 && (hung_up & (POLLHUP | POLLERR)) != 0)) return lose(id);
        if (count == 0) client->second.has_ended = true;
        watch(id, client->second);
        return {bytes, count == 0 || hung_up != 0 ? State::hears : State::open};
    }

    bool is_open(Id id) const override {
        const auto client = clients_.find(id);
        return client != clients_.end() && !client->second.has_ended && hang_up(client->second.socket) == 0;
    }

    std::optional<std::size_t> write(Id id, std::span<const std::uint8_t> bytes) override {
        const auto client = clients_.find(id);
        if (client == clients_.end()) return std::nullopt;
        const ssize_t taken = ::send(client->second.socket.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (taken >= 0) return static_cast<std::size_t>(taken);
        if (errno == EAGAIN || errno == EINTR) return 0;
        close(id);
        return std::nullopt;
    }

    void listen_to(Id id, bool on) override { set(id, &Client::is_listened_to, on); }
    void wait_to_write(Id id, bool on) override { set(id, &Client::waits_to_write, on); }
    void close(Id id) override { clients_.erase(id); }

  private:
    struct Client {
        FileDescriptor socket{};
        StreamOpening opening{};
        bool is_listened_to = true;
        bool waits_to_write = false;
        bool has_ended = false;  ///< end of stream reached
        std::uint32_t watched = EPOLLIN | EPOLLRDHUP;
    };

    Peer peer_of(int socket) const {
        if (!is_tcp_) {
            ucred user{};
            socklen_t size = sizeof user;
            if (::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &user, &size) != 0) return {};
            return {Peer::Kind::user, user.uid, 0};
        }
        sockaddr_in address{};
        socklen_t size = sizeof address;
        if (::getpeername(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0) return {};
        return {Peer::Kind::address, ntohl(address.sin_addr.s_addr), ntohs(address.sin_port)};
    }
    static short hang_up(const FileDescriptor& socket) {
        pollfd state{.fd = socket.get(), .events = POLLRDHUP, .revents = 0};
        return ::poll(&state, 1, 0) == 1 ? state.revents : short{0};
    }
    Got lose(Id id) {
        close(id);
        return {0, State::gone};
    }
    void set(Id id, bool Client::*which, bool on) {
        const auto client = clients_.find(id);
        if (client == clients_.end() || client->second.*which == on) return;
        client->second.*which = on;
        watch(id, client->second);
    }
    void watch(Id id, Client& client) {
        std::uint32_t events = client.waits_to_write ? EPOLLOUT : 0U;
        if (client.is_listened_to && !client.has_ended) events |= EPOLLIN | EPOLLRDHUP;
        if (events == client.watched) return;
        client.watched = events;
        control(EPOLL_CTL_MOD, client.socket.get(), id, events);
    }
    void control(int what, int descriptor, Id id, std::uint32_t events) {
        epoll_event event{.events = events, .data = {.u64 = id}};
        ::epoll_ctl(all_.get(), what, descriptor, &event);
    }

    FileDescriptor all_{::epoll_create1(EPOLL_CLOEXEC)};  ///< readable when one of the others is
    ListeningSocket listener_;
    std::map<Id, Client> clients_;
    Id last_ = 0;
    unsigned turned_away_ = 0;
    bool lacks_room_ = false;
    bool is_tcp_;
};

/// A client that opens the terminal between two looks, after another one has closed it, counts as the same
/// one.
class TerminalConnections final : public Connections {
  public:
    explicit TerminalConnections(std::unique_ptr<ByteServer> terminal) : terminal_(std::move(terminal)) {}

    const std::string& name() const override { return terminal_->name(); }
    int descriptor() const override { return terminal_->descriptor(); }
    std::optional<Id> accept() override {
        if (is_there_ || (!terminal_->has_client() && !is_readable())) return std::nullopt;
        is_there_ = true;
        return ++last_;
    }
    Peer peer(Id) const override { return {}; }
    std::vector<Id> with_news() override { return is_there_ ? std::vector{last_} : std::vector<Id>{}; }
    /// A client that closed the terminal during the read has left; the rest of its data is read the next
    /// time.
    Got read(Id client, std::span<std::uint8_t> out) override {
        if (!is_there_ || client != last_) return {0, State::gone};
        const bool was_open = terminal_->has_client();
        const std::size_t count = terminal_->read(out);
        if (was_open) return {count, terminal_->has_client() ? State::open : State::hears};
        is_there_ = count == out.size();
        return {count, count == 0 ? State::gone : State::hears};
    }
    bool is_open(Id client) const override { return is_there_ && client == last_ && terminal_->has_client(); }
    std::optional<std::size_t> write(Id client, std::span<const std::uint8_t> bytes) override {
        if (is_there_ && client == last_) terminal_->write(bytes);
        return bytes.size();
    }
    void listen_to(Id, bool) override {}
    void wait_to_write(Id, bool) override {}
    void close(Id) override { is_there_ = false; }

  private:
    bool is_readable() const {
        pollfd state{.fd = descriptor(), .events = POLLIN, .revents = 0};
        return ::poll(&state, 1, 0) == 1 && (state.revents & POLLIN) != 0;
    }

    std::unique_ptr<ByteServer> terminal_;
    bool is_there_ = false;
    Id last_ = 0;
};

Connections::Opened serve(ListeningSocket listener, bool is_tcp) {
    if (!listener.error.empty()) return {nullptr, listener.error};
    return {std::make_unique<SocketConnections>(std::move(listener), is_tcp), {}};
}

}  // namespace

Connections::Opened Connections::open(const std::string& endpoint, const ByteServer::Settings& settings) {
    const host::Endpoint line(endpoint);
    if (!line.place.empty() && line.kind == host::Endpoint::Kind::unix_socket)
        return serve(listen_at_path(line.place, settings), false);
    if (!line.place.empty() && line.kind == host::Endpoint::Kind::tcp)
        return serve(listen_at_port(line.place), true);
    auto terminal = ByteServer::open(endpoint, settings);
    if (!terminal.server) return {nullptr, terminal.error};
    return {std::make_unique<TerminalConnections>(std::move(terminal.server)), {}};
}

}  // namespace nplc::hal_linux
