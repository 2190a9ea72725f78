#pragma once

#include <memory>
#include <string>
#include <thread>

#include "faces/axis_model.h"
#include "mqtt/options.h"

namespace nplc::mqtt {

/// An MQTT client that shows axes as Sparkplug B's edge node, in a thread of its own. It connects again for
/// ever, and says through Options::tell what came of it.
class Client {
  public:
    struct Opened {
        std::unique_ptr<Client> client;
        std::string error;  ///< one line
    };
    /// A secret or certificate that cannot be read is an error here; a broker that is away is none. From the
    /// axes' loop, before it begins or later; they must outlive it.
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
