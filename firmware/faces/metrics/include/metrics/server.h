#pragma once

#include <memory>
#include <string>
#include <thread>

#include "faces/axis_model.h"

namespace nplc::metrics {

/// `GET /metrics` over HTTP/1.1, in its own thread, for Prometheus and compatible programs. Read-only. While
/// it is scraped at least once a minute, the motors' values are kept up to date.
class Server {
  public:
    struct Options {
        std::string listen;   ///< "127.0.0.1:9464" or "tcp:127.0.0.1:9464"; IPv6 in brackets
        std::string program;  ///< its version
    };
    struct Opened {
        std::unique_ptr<Server> server;
        std::string error;  ///< one line
    };
    /// To be called before the axes' loops begin; the axes must outlive it.
    static Opened open(const Options& options, const faces::Axes& axes);
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    /// "http://127.0.0.1:9464/metrics", with the port that the system chose.
    const std::string& url() const { return url_; }

    /// Why the address is invalid; empty if it is valid.
    static std::string mistake_in(const std::string& listen);

  private:
    class Loop;
    Server();

    std::string url_;
    std::unique_ptr<Loop> loop_;
    std::thread thread_;
};

}  // namespace nplc::metrics
