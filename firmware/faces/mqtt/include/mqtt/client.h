#pragma once

#include <memory>
#include <string>
#include <thread>

#include "faces/axis_model.h"
#include "mqtt/options.h"

namespace nplc::mqtt {

/// An MQTT client that publishes axes as a Sparkplug B edge node, in its own thread. Reconnects forever, and
/// reports its state through Options::tell.
class Client {
  public:
    struct Opened {
        std::unique_ptr<Client> client;
        std::string error;  ///< one line
    };
    /// An unreadable secret or certificate is an error here; an unreachable broker is not. To be called by
    /// the axes' loop, before it begins or later; the axes must outlive it.
    static Opened open(const Options& options, const faces::Axes& axes);
    ~Client();
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;

  private:
    class Loop;
    Client();

    std::unique_ptr<Loop> loop_;
    std::thread thread_;
};

}  // namespace nplc::mqtt
