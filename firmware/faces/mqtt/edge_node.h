#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "faces/axis_model.h"
#include "items.h"
#include "mqtt/options.h"
#include "sparkplug.h"
#include "store.h"

namespace nplc::mqtt {

constexpr std::string_view kRebirth = "Node Control/Rebirth";
constexpr std::uint64_t kRebirthAlias = 1;
constexpr std::string_view kCommand = "Command/";
constexpr std::uint64_t kCommandAlias = 910;  ///< of the first command of a device

using deployment::Moment;

/// A received message.
struct Incoming {
    std::string_view topic{};
    std::string_view payload{};
    bool is_retained = false;
    base::Instant arrived{};  ///< lower limit; a message that may have waited longer than 1 s starts nothing
};

/// The axes as a Sparkplug B edge node with its devices (Sparkplug 3.0 §6.4). Does no network I/O: messages
/// are sent by `publish`, which returns whether the connection accepted them.
class EdgeNode {
  public:
    using Publish = std::function<bool(const std::string& topic, const std::string& payload)>;

    EdgeNode(const Options& options, const faces::Axes& axes, faces::Bell& bell);
    EdgeNode(const EdgeNode&) = delete;
    EdgeNode& operator=(const EdgeNode&) = delete;

    /// To be called before each connect: a new bdSeq. Then read topic and payload of the will.
    void begin_session();
    std::string death_topic() const { return topic("NDEATH"); }
    std::string death_payload(std::uint64_t milliseconds) const;
    std::vector<std::string> subscriptions() const;

    /// The broker has confirmed the subscriptions.
    void connected() { is_connected_ = true; }
    void disconnected();
    void receive(const Incoming& message, const Moment& moment);
    /// To be called regularly, connected or not.
    void tick(const Moment& moment, const Publish& publish);
    /// The primary host is offline: this session must end.
    bool wants_to_leave() const { return wants_to_leave_; }

    Store& store() { return store_; }

  private:
    /// Time and origin of a command.
    struct Given {
        const Incoming& message;
        std::uint64_t timestamp;
        std::uint64_t now;  ///< milliseconds since 1970
    };
    struct Device {
        faces::AxisModel* axis = nullptr;
        std::unique_ptr<faces::CommandDesk::Client> client{};
        std::vector<Item> items{};
        std::size_t points = 0;  ///< number of the model's items; set-points follow
        std::shared_ptr<const faces::SetPointBook> book{};  ///< of the set-point items
        std::uint16_t edition = 0;                          ///< increases with each book
        bool is_born = false;
        std::vector<faces::PointValue> last{};  ///< last values of the items; empty: none yet
        std::uint64_t last_command = 0;         ///< its timestamp
        std::uint32_t command_id = 0;           ///< in progress
        std::string command{};                  ///< the last one
        bool sets_values = false;               ///< the last one is of set-points
        bool stop_waits = false;                ///< the last one is a stop without an answer yet
        std::int64_t result = 0;
        std::string result_text{};
        bool result_changed = false;
        std::string why{};  ///< causes of a standstill as text; empty: unknown
        bool why_changed = false;
    };

    std::string topic(std::string_view type, std::string_view device = {}) const;
    std::uint64_t alias_of(std::size_t device, std::size_t metric) const;
    bool may_publish() const { return is_connected_ && (options_.primary_host.empty() || host_is_online_); }
    bool send(const Publish& publish, const std::string& to, std::vector<Metric> metrics,
              std::uint64_t milliseconds);
    void bear_node(const Publish& publish, std::uint64_t milliseconds);
    void bear_device(std::size_t index, const Publish& publish, const Moment& moment);
    void look(std::size_t index, const Moment& moment);
    void flush(const Publish& publish, std::uint64_t milliseconds);
    void report(std::size_t index, const Publish& publish, const Moment& moment);
    std::vector<Metric> result_metrics(std::size_t index) const;
    Metric why_metric(std::size_t index) const;
    Metric metric_of(const Record& record) const;
    void follow_set_points(Device& device);
    bool is_outdated(const Record& record) const;
    bool is_host_state(std::string_view topic) const;
    void take_host_state(std::string_view payload);
    void take_device_command(std::size_t index, const Payload& payload, const Incoming& message,
                             std::uint64_t milliseconds);
    std::optional<registers::gateway::Command> allowed_command(std::size_t index, const Metric& metric) const;
    /// The strongest permitted stop, safe or hold; null: none.
    const Metric* stop_in(std::size_t index, const Payload& payload) const;
    void take_command(std::size_t index, const Metric& metric, const Given& given);
    void take_set_points(std::size_t index, const std::vector<const Metric*>& metrics, const Given& given);
    std::optional<std::size_t> set_point_of(std::size_t index, const Metric& metric) const;
    bool is_of_recipe(std::size_t index, const Metric& metric) const;
    std::string take_timestamp(Device& device, const Given& given, bool stops);
    void refuse_what_is_none(std::size_t index, const Payload& payload);
    void submit(Device& device, const std::string& what, const faces::Command& command);
    void refuse(Device& device, const std::string& what, faces::Result result, const std::string& text = {});

    Options options_;
    std::vector<Device> devices_;
    Store store_;
    bool is_connected_ = false;
    bool is_born_ = false;
    bool wants_rebirth_ = false;
    bool host_is_online_ = false;
    bool wants_to_leave_ = false;
    std::uint64_t host_since_ = 0;  ///< timestamp of the host's last state
    std::uint8_t seq_ = 0;
    std::uint8_t bd_seq_ = 255;
    std::uint64_t born_at_ = 0;  ///< older records are historical
    std::uint64_t told_dropped_ = 0;
    base::Instant next_look_{};
    base::Instant next_birth_{};  ///< of those that hosts ask for
};

}  // namespace nplc::mqtt
