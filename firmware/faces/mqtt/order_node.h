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

/// Orders for the axes, their pieces, and what the axes say of themselves, at topics beside Sparkplug's.
/// Knows no socket.
class OrderNode {
  public:
    /// How messages go out; each says whether the connection took it. What is published is retained.
    struct Link {
        std::function<bool(const std::string& topic, const std::string& payload)> publish;
        std::function<bool(const std::string& topic)> subscribe;
        std::function<bool(const std::string& topic)> unsubscribe;
    };

    /// No axis where the options name no keys.
    OrderNode(const Options& options, const faces::Axes& axes, faces::Bell& bell);

    void connected();
    void disconnected() { is_connected_ = false; }
    /// False: the topic is none of ours.
    bool receive(std::string_view topic, std::string_view payload, const deployment::Moment& moment);
    /// Now and then, connected or not.
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
    std::map<std::string, base::Instant> asked_;  ///< topics of pieces, and when they were subscribed to
};

}  // namespace nplc::mqtt
