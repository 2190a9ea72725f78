#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "deployment/deployment.h"
#include "faces/axis_model.h"
#include "mqtt/options.h"

namespace nplc::mqtt {

/// Orders for the axes, their pieces, and the axes' reports, on topics besides Sparkplug's. Does no network
/// I/O.
class OrderNode {
  public:
    /// Functions for sending; each returns whether the connection accepted the message. Published messages
    /// are retained.
    struct Link {
        std::function<bool(const std::string& topic, const std::string& payload)> publish;
        std::function<bool(const std::string& topic)> subscribe;
        std::function<bool(const std::string& topic)> unsubscribe;
    };

    /// Handles no axis if the options name no keys.
    OrderNode(const Options& options, const faces::Axes& axes, faces::Bell& bell);

    void connected();
    void disconnected() { is_connected_ = false; }
    /// False: another topic.
    bool receive(std::string_view topic, std::string_view payload, const deployment::Moment& moment);
    /// To be called regularly, connected or not.
    void tick(const deployment::Moment& moment, const Link& link);

  private:
    struct Part {
        std::unique_ptr<deployment::Deployment> deployment;
        orders::Report told{};
        bool was_told = false;
        base::Instant told_at{};
    };
    void tell(Part& part, const deployment::Moment& moment, const Link& link) const;
    void follow_wanted(const deployment::Moment& moment, const Link& link);

    base::Milliseconds report_every_;
    std::vector<Part> parts_;
    bool is_connected_ = false;
    bool is_subscribed_ = false;                  ///< to orders
    std::map<std::string, base::Instant> asked_;  ///< topics of pieces with the time of the subscription
};

}  // namespace nplc::mqtt
