#include "panel/web_server.h"

#include <fmt/format.h>

#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <chrono>
#include <deque>
#include <map>
#include <optional>
#include <utility>

#include "hal_linux/tcp_listener.h"
#include "origin.h"

namespace nplc::panel {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using Error = beast::error_code;

constexpr auto kRequestTime = std::chrono::seconds{10};
constexpr std::size_t kHeaderBytes = std::size_t{8} * 1024;
constexpr std::uint16_t kPlaceTaken = 4001;
constexpr std::uint16_t kTooSlow = 4002;
constexpr std::string_view kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'; require-trusted-types-for 'script'";

using Request = http::request<http::empty_body>;
using Response = http::response<http::string_body>;

class Server;

/// One WebSocket. It exists as long as one of its operations is in progress.
class Socket : public std::enable_shared_from_this<Socket> {
  public:
    Socket(Server& server, ClientId id, beast::tcp_stream stream, std::string peer)
        : server_(server), id_(id), peer_(std::move(peer)), stream_(std::move(stream)) {}

    void accept(const Request& request);
    void send(std::string text);
    void close(std::uint16_t code, std::string_view reason);
    std::size_t waiting() const { return waiting_; }
    std::uint64_t last_heard() const { return heard_; }

  private:
    void read();
    void write();
    void send_close();
    void end();

    Server& server_;
    ClientId id_;
    std::string peer_;
    websocket::stream<beast::tcp_stream> stream_;
    beast::flat_buffer in_;
    std::deque<std::string> out_;
    std::size_t waiting_ = 0;
    std::uint64_t heard_ = 0;  ///< sequence number of its last message over all clients
    std::optional<websocket::close_reason> closing_;
    bool is_open_ = false;
    bool has_ended_ = false;
    bool close_sent_ = false;
};

/// A connection before its purpose is known.
class Connection : public std::enable_shared_from_this<Connection> {
  public:
    Connection(Server& server, tcp::socket socket);
    ~Connection();
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;
    void read();

  private:
    void handle(const Request& request);
    void answer(const Request& request, http::status status, std::string_view type, std::string_view body);

    Server& server_;
    beast::tcp_stream stream_;
    beast::flat_buffer buffer_;
    std::optional<http::request_parser<http::empty_body>> parser_;
    std::optional<Response> response_;
};

class Server final : public WebServer {
  public:
    Server(WebOptions options, std::span<const WebFile> files, WebHandler& handler)
        : options_(std::move(options)), files_(files), handler_(handler) {}

    std::string listen();

    std::uint16_t port() const override { return port_; }
    void run() override {
        accept();
        await_bell();
        context_.run();
    }
    void stop() override { context_.stop(); }
    void ring() override {
        const std::uint64_t one = 1;
        [[maybe_unused]] const auto written = ::write(bell_.native_handle(), &one, sizeof one);
    }
    void send(ClientId client, std::string text) override {
        if (const auto found = sockets_.find(client); found != sockets_.end())
            found->second->send(std::move(text));
    }
    std::size_t waiting(ClientId client) const override {
        const auto found = sockets_.find(client);
        return found == sockets_.end() ? 0 : found->second->waiting();
    }
    void close(ClientId client, std::uint16_t code, std::string_view reason) override {
        const auto found = sockets_.find(client);
        if (found == sockets_.end()) return;
        const auto socket = found->second;
        forget(client);
        socket->close(code, reason);
    }

    const WebOptions& options() const { return options_; }
    std::size_t& connections() { return connections_; }
    std::uint64_t next_turn() { return ++turn_; }
    const WebFile* find(std::string_view path) const;
    bool allows(const Request& request) const;
    void open_websocket(beast::tcp_stream stream, const Request& request);
    void opened(ClientId client, std::shared_ptr<Socket> socket, const std::string& peer);
    void received(ClientId client, std::string_view text) {
        if (sockets_.contains(client)) handler_.received(client, text);
    }
    void forget(ClientId client);

  private:
    void accept();
    void tick();
    void await_bell();
    bool make_room();

    WebOptions options_;
    std::span<const WebFile> files_;
    WebHandler& handler_;
    asio::io_context context_{1};
    tcp::acceptor acceptor_{context_};
    asio::steady_timer retry_{context_};
    asio::steady_timer tick_timer_{context_};
    asio::posix::stream_descriptor bell_{context_, ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)};
    std::map<ClientId, std::shared_ptr<Socket>> sockets_;
    std::uint16_t port_ = 0;
    ClientId last_id_ = 0;
    std::size_t connections_ = 0;
    std::uint64_t turn_ = 0;
    bool ticks_ = false;
};

void Socket::accept(const Request& request) {
    auto times = websocket::stream_base::timeout::suggested(beast::role_type::server);
    times.idle_timeout = std::chrono::seconds{20};
    times.keep_alive_pings = true;
    stream_.set_option(times);
    stream_.read_message_max(server_.options().limits.message_bytes);
    stream_.text(true);
    beast::get_lowest_layer(stream_).expires_never();
    stream_.async_accept(request, [self = shared_from_this()](Error error) {
        if (error) return;
        self->is_open_ = true;
        self->heard_ = self->server_.next_turn();
        self->server_.opened(self->id_, self, self->peer_);
        self->read();
    });
}

void Socket::read() {
    stream_.async_read(in_, [self = shared_from_this()](Error error, std::size_t) {
        if (error) return self->end();
        self->heard_ = self->server_.next_turn();
        const auto data = self->in_.cdata();
        const std::string_view text(static_cast<const char*>(data.data()), data.size());
        if (self->stream_.got_text()) {
            self->server_.received(self->id_, text);
        } else {
            self->close(1003, "text messages only");
        }
        self->in_.consume(self->in_.size());
        self->read();
    });
}

void Socket::send(std::string text) {
    if (!is_open_ || closing_) return;
    waiting_ += text.size();
    if (waiting_ > server_.options().limits.waiting_bytes) return close(kTooSlow, "does not read");
    out_.push_back(std::move(text));
    if (out_.size() == 1) write();
}

void Socket::write() {
    stream_.async_write(asio::buffer(out_.front()), [self = shared_from_this()](Error error, std::size_t) {
        if (error) return self->end();
        self->waiting_ -= self->out_.front().size();
        self->out_.pop_front();
        if (self->closing_) return self->send_close();
        if (!self->out_.empty()) self->write();
    });
}

void Socket::close(std::uint16_t code, std::string_view reason) {
    if (closing_) return;
    closing_ =
        websocket::close_reason(static_cast<websocket::close_code>(code), {reason.data(), reason.size()});
    server_.forget(id_);
    if (out_.empty()) return send_close();
    // A write in progress is completed first; a client that does not read is closed at once.
    if (code == kTooSlow) beast::get_lowest_layer(stream_).close();
}

void Socket::send_close() {
    if (std::exchange(close_sent_, true)) return;
    stream_.async_close(*closing_, [self = shared_from_this()](Error) { self->end(); });
}

void Socket::end() {
    if (std::exchange(has_ended_, true)) return;
    is_open_ = false;
    server_.forget(id_);
}

Connection::Connection(Server& server, tcp::socket socket) : server_(server), stream_(std::move(socket)) {
    ++server_.connections();
}

Connection::~Connection() {
    --server_.connections();
}

void Connection::read() {
    parser_.emplace();
    parser_->header_limit(kHeaderBytes);
    parser_->body_limit(0);
    stream_.expires_after(kRequestTime);
    http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](Error error, std::size_t) {
        if (error) return;
        self->handle(self->parser_->get());
    });
}

void Connection::handle(const Request& request) {
    constexpr std::string_view kText = "text/plain; charset=utf-8";
    if (!server_.allows(request))
        return answer(request, http::status::forbidden, kText,
                      "This panel does not know the name or the page that asks. Use the address that the "
                      "program printed, or add the name to `hosts` in the configuration.\n");
    if (websocket::is_upgrade(request)) {
        if (request.target() != "/live")
            return answer(request, http::status::not_found, kText, "See /live.\n");
        return server_.open_websocket(std::move(stream_), request);
    }
    if (request.method() != http::verb::get && request.method() != http::verb::head)
        return answer(request, http::status::method_not_allowed, kText, "GET only.\n");
    const auto target = request.target();
    const WebFile* file = server_.find(std::string_view(target.data(), target.size()));
    if (file == nullptr) return answer(request, http::status::not_found, kText, "There is nothing here.\n");
    answer(request, http::status::ok, file->type, file->body);
}

void Connection::answer(const Request& request, http::status status, std::string_view type,
                        std::string_view body) {
    Response& response = response_.emplace(status, request.version());
    response.set(http::field::content_type, {type.data(), type.size()});
    response.set(http::field::cache_control, "no-store");
    response.set("Content-Security-Policy", {kPolicy.data(), kPolicy.size()});
    response.set("X-Content-Type-Options", "nosniff");
    response.set("Referrer-Policy", "no-referrer");
    response.set("Cross-Origin-Opener-Policy", "same-origin");
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    response.keep_alive(request.keep_alive() && status == http::status::ok);
    response.content_length(body.size());
    if (request.method() != http::verb::head) response.body().assign(body);
    stream_.expires_after(kRequestTime);
    http::async_write(stream_, response, [self = shared_from_this()](Error error, std::size_t) {
        if (error) return;
        if (self->response_->keep_alive()) return self->read();
        self->stream_.socket().shutdown(tcp::socket::shutdown_send, error);
    });
}

std::string Server::listen() {
    Error error;
    const auto address =
        asio::ip::make_address(options_.address == "localhost" ? "127.0.0.1" : options_.address, error);
    if (error)
        return fmt::format("\"{}\" is no address of a machine; write one such as 127.0.0.1",
                           options_.address);
    const tcp::endpoint endpoint(address, options_.port);
    acceptor_.open(endpoint.protocol(), error);
    if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error)
        return fmt::format("cannot listen at {} port {}: {}; {}", options_.address, options_.port,
                           error.message(), hal_linux::listen_remedy(error.value()));
    port_ = acceptor_.local_endpoint(error).port();
    if (!address.is_unspecified())
        options_.hosts.push_back(address.is_v6() ? "[" + address.to_string() + "]" : address.to_string());
    return {};
}

void Server::accept() {
    acceptor_.async_accept([this](Error error, tcp::socket socket) {
        if (error) {
            // Out of descriptors, for example: retried a little later.
            retry_.expires_after(std::chrono::milliseconds{100});
            retry_.async_wait([this](Error) { accept(); });
            return;
        }
        if (connections_ < options_.limits.connections) {
            Error ignored;
            socket.set_option(tcp::no_delay(true), ignored);
            std::make_shared<Connection>(*this, std::move(socket))->read();
        }
        accept();
    });
}

const WebFile* Server::find(std::string_view path) const {
    const auto found =
        std::find_if(files_.begin(), files_.end(), [&](const WebFile& file) { return file.path == path; });
    return found == files_.end() ? nullptr : &*found;
}

bool Server::allows(const Request& request) const {
    const auto text = [&](http::field field) {
        const auto value = request[field];
        return std::string_view(value.data(), value.size());
    };
    const std::string_view host = text(http::field::host);
    if (!is_our_host(host, options_.hosts)) return false;
    if (request.find("Sec-Fetch-Site") != request.end() && websocket::is_upgrade(request) &&
        request["Sec-Fetch-Site"] != "same-origin")
        return false;
    const std::string_view origin = text(http::field::origin);
    return request.find(http::field::origin) == request.end() || is_same_origin(origin, host);
}

bool Server::make_room() {
    if (sockets_.size() < options_.limits.clients) return true;
    auto quietest = sockets_.end();
    for (auto it = sockets_.begin(); it != sockets_.end(); ++it) {
        if (!handler_.may_go(it->first)) continue;
        if (quietest == sockets_.end() || it->second->last_heard() < quietest->second->last_heard())
            quietest = it;
    }
    if (quietest == sockets_.end()) return false;
    close(quietest->first, kPlaceTaken, "another client took this place");
    return true;
}

void Server::open_websocket(beast::tcp_stream stream, const Request& request) {
    Error error;
    const auto peer = stream.socket().remote_endpoint(error);
    const std::string name = error ? "unknown" : peer.address().to_string();
    std::make_shared<Socket>(*this, ++last_id_, std::move(stream), name)->accept(request);
}

void Server::opened(ClientId client, std::shared_ptr<Socket> socket, const std::string& peer) {
    if (!make_room()) return socket->close(kPlaceTaken, "no place is free");
    sockets_.emplace(client, std::move(socket));
    handler_.opened(client, peer);
    if (!std::exchange(ticks_, true)) tick();
}

void Server::forget(ClientId client) {
    if (sockets_.erase(client) != 0) handler_.closed(client);
}

void Server::tick() {
    if (sockets_.empty()) {
        ticks_ = false;
        return;
    }
    handler_.tick();
    tick_timer_.expires_after(std::chrono::milliseconds{kTickMilliseconds});
    tick_timer_.async_wait([this](Error) { tick(); });
}

void Server::await_bell() {
    bell_.async_wait(asio::posix::stream_descriptor::wait_read, [this](Error error) {
        if (error) return;
        std::uint64_t rung = 0;
        [[maybe_unused]] const auto got = ::read(bell_.native_handle(), &rung, sizeof rung);
        if (!sockets_.empty()) handler_.tick();
        await_bell();
    });
}

}  // namespace

WebServer::Opened WebServer::open(const WebOptions& options, std::span<const WebFile> files,
                                  WebHandler& handler) {
    auto server = std::make_unique<Server>(options, files, handler);
    if (std::string error = server->listen(); !error.empty()) return {nullptr, std::move(error)};
    return {std::move(server), {}};
}

}  // namespace nplc::panel
