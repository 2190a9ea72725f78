#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nplc::panel {

/// A browser's connection; never reused in one run.
using ClientId = std::uint32_t;

/// A file for browsers.
struct WebFile {
    std::string_view path;  ///< `/panel.js`
    std::string_view type;  ///< `text/javascript; charset=utf-8`
    std::string_view body;
};

struct WebLimits {
    std::size_t clients =
        32;  ///< WebSockets at once; a further one replaces the one that is silent the longest
    std::size_t connections = 96;                        ///< in total, including file requests
    std::size_t message_bytes = std::size_t{64} * 1024;  ///< of one message from a client
    std::size_t waiting_bytes =
        std::size_t{2} * 1024 * 1024;  ///< for a client that does not read; then it is closed
};

struct WebOptions {
    std::string address = "127.0.0.1";
    std::uint16_t port = 0;            ///< 0: any that is free
    std::vector<std::string> hosts{};  ///< names by which browsers reach it, besides this machine's own
    WebLimits limits{};
};

/// The server's application. All calls are on the thread of WebServer::run().
class WebHandler {
  public:
    virtual void opened(ClientId client, const std::string& peer) = 0;
    virtual void received(ClientId client, std::string_view text) = 0;
    virtual void closed(ClientId client) = 0;
    /// Whether this client may be replaced by another one.
    virtual bool may_go(ClientId client) = 0;
    /// After ring(), and every kTickMilliseconds while there are clients.
    virtual void tick() = 0;

  protected:
    ~WebHandler() = default;
};

/// HTTP and WebSocket on its own thread. Answers GET of its files, and a WebSocket at `/live`, both only for
/// its own host names; a WebSocket with an Origin only for its own pages.
class WebServer {
  public:
    static constexpr std::uint32_t kTickMilliseconds = 50;

    struct Opened {
        std::unique_ptr<WebServer> server;
        std::string error;  ///< one line, if it cannot be started
    };
    /// Listens at once. `files` and `handler` must outlive it.
    static Opened open(const WebOptions& options, std::span<const WebFile> files, WebHandler& handler);

    virtual ~WebServer() = default;

    virtual std::uint16_t port() const = 0;
    /// Serves until stop(), which any thread may call.
    virtual void run() = 0;
    virtual void stop() = 0;
    /// From any thread: requests a tick(). Never blocks.
    virtual void ring() = 0;

    // On the thread of run() only.
    virtual void send(ClientId client, std::string text) = 0;
    /// Bytes that the client has not read yet.
    virtual std::size_t waiting(ClientId client) const = 0;
    /// `code` as in RFC 6455 §7.4, 4000 and up are PROTOCOL.md's.
    virtual void close(ClientId client, std::uint16_t code, std::string_view reason) = 0;
};

/// Whether it is a loopback address: 127.x.x.x, ::1 or localhost.
bool is_loopback(std::string_view address);

}  // namespace nplc::panel
