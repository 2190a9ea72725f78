#pragma once

#include <memory>
#include <string>
#include <thread>

#include "faces/axis_model.h"

namespace nplc::metrics {

/// `GET /metrics` over HTTP/1.1, in a thread of its own, for Prometheus and what speaks its text format.
/// Nothing can be written there. While somebody scrapes, once a minute or more often, the motors' values are
/// kept fresh.
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
    /// Before the axes' loops begin; they must outlive it.
    static Opened open(const Options& options, const faces::Axes& axes);
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    /// "http://127.0.0.1:9464/metrics", with the port that the system chose.
    const std::string& url() const { return url_; }

    /// Why this is no place to listen; empty: it is one.
    static std::string mistake_in(const std::string& listen);

  private:
    class Loop;
    Server();

    std::string url_;
    std::unique_ptr<Loop> loop_;
    std::thread thread_;
};

}  // namespace nplc::metrics
