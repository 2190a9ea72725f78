#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nplc::panel {

/// A browser's connection; never used again in one run.
using ClientId = std::uint32_t;

/// Something that a browser may fetch.
struct WebFile {
    std::string_view path;  ///< `/panel.js`
    std::string_view type;  ///< `text/javascript; charset=utf-8`
    std::string_view body;
};

struct WebLimits {
    std::size_t clients = 32;      ///< WebSockets at once; one more takes the place of the quietest
    std::size_t connections = 96;  ///< all, with those that fetch a file
    std::size_t message_bytes = std::size_t{64} * 1024;  ///< of one message from a client
    std::size_t waiting_bytes =
        std::size_t{2} * 1024 * 1024;  ///< for a client that does not read; then it is closed
};

struct WebOptions {
    std::string address = "127.0.0.1";
    std::uint16_t port = 0;            ///< 0: any that is free
    std::vector<std::string> hosts{};  ///< names by which browsers reach it, beside this machine's own
    WebLimits limits{};
};

/// What lives behind the server. All calls come on the thread of WebServer::run().
class WebHandler {
  public:
    virtual void opened(ClientId client, const std::string& peer) = 0;
    virtual void received(ClientId client, std::string_view text) = 0;
    virtual void closed(ClientId client) = 0;
    /// May this client lose its place to another one?
    virtual bool may_go(ClientId client) = 0;
    /// Somebody has rung, and every kTickMilliseconds while there are clients.
    virtual void tick() = 0;

  protected:
    ~WebHandler() = default;
};

/// HTTP and WebSocket on one thread of its own. It answers GET of its files, and a WebSocket at `/live`, both
/// only for its own host names; a WebSocket with an Origin only for pages of its own.
class WebServer {
  public:
    static constexpr std::uint32_t kTickMilliseconds = 50;

    struct Opened {
        std::unique_ptr<WebServer> server;
        std::string error;  ///< one line, if there is no server
    };
    /// Listens at once. `files` and `handler` must outlive it.
    static Opened open(const WebOptions& options, std::span<const WebFile> files, WebHandler& handler);

    virtual ~WebServer() = default;

    virtual std::uint16_t port() const = 0;
    /// Serves until stop(), which any thread may call.
    virtual void run() = 0;
    virtual void stop() = 0;
    /// From any thread: tick() soon. Never waits.
    virtual void ring() = 0;

    // On the thread of run() only.
    virtual void send(ClientId client, std::string text) = 0;
    /// Bytes that the client has not taken yet.
    virtual std::size_t waiting(ClientId client) const = 0;
    /// `code` as in RFC 6455 §7.4, 4000 and up are PROTOCOL.md's.
    virtual void close(ClientId client, std::uint16_t code, std::string_view reason) = 0;
};

/// Is it this machine's own: 127.x.x.x, ::1 or localhost?
bool is_loopback(std::string_view address);

}  // namespace nplc::panel
