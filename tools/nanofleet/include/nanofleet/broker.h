#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "broker/options.h"

namespace nplc::nanofleet {

/// A connection to an MQTT broker that comes back when it is lost: what was subscribed to is so again, and
/// what was published last at each topic goes out once more.
class Broker {
  public:
    using Take = std::function<void(std::string_view topic, std::string_view payload)>;

    /// Throws Failure with exit code 3 if it cannot be had.
    Broker(const broker::Options& options, Take take);
    ~Broker();
    Broker(const Broker&) = delete;
    Broker& operator=(const Broker&) = delete;

    void subscribe(const std::vector<std::string>& topics);
    /// Retained, quality 1.
    void publish(const std::string& topic, const std::string& payload);
    /// For so long at the most, while nothing comes.
    void serve(int milliseconds);
    /// Subscriptions and messages that the broker has not confirmed.
    std::size_t unconfirmed() const;
    bool is_connected() const;
    /// It does not let us read something that was subscribed to.
    bool is_denied() const;

  private:
    class Session;
    std::unique_ptr<Session> session_;
};

}  // namespace nplc::nanofleet
