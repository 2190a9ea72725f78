#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "broker/options.h"

namespace nplc::nanofleet {

/// A connection to an MQTT broker that reconnects: subscriptions are renewed, and the last message of each
/// topic is published again.
class Broker {
  public:
    using Take = std::function<void(std::string_view topic, std::string_view payload)>;

    /// Throws Failure with exit code 3 if there is no connection.
    Broker(const broker::Options& options, Take take);
    ~Broker();
    Broker(const Broker&) = delete;
    Broker& operator=(const Broker&) = delete;

    void subscribe(const std::vector<std::string>& topics);
    /// Retained, QoS 1.
    void publish(const std::string& topic, const std::string& payload);
    /// Waits this long at the most, while nothing is received.
    void serve(int milliseconds);
    /// Subscriptions and messages without a confirmation of the broker.
    std::size_t unconfirmed() const;
    bool is_connected() const;
    /// The broker refused one of the subscriptions.
    bool is_denied() const;

  private:
    class Session;
    std::unique_ptr<Session> session_;
};

}  // namespace nplc::nanofleet
