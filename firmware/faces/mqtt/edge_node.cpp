#include "edge_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "faces/program_version.h"

namespace nplc::mqtt {

namespace gw = registers::gateway;
using faces::PointValue;
using faces::Quality;
using faces::Result;

namespace {

constexpr std::string_view kNamespace = "spBv1.0/";
constexpr std::string_view kDropped = "Node Info/Dropped";
constexpr std::string_view kVersion = "Node Info/Version";
constexpr std::string_view kLast = "Command/last";
constexpr std::string_view kResult = "Command/result";
constexpr std::string_view kText = "Command/text";
constexpr std::string_view kWhyText = "why_text";
constexpr std::uint64_t kWhyAlias = 903;
constexpr std::uint64_t kDroppedAlias = 2;
constexpr std::uint64_t kVersionAlias = 3;
constexpr std::uint64_t kFirstAlias = 100;
constexpr std::uint64_t kAliasesOfDevice = 1'000;
constexpr std::uint64_t kLastAlias = 900;
constexpr std::uint64_t kResultAlias = 901;
constexpr std::uint64_t kTextAlias = 902;
constexpr std::size_t kMostOfMessage = 100;
constexpr int kMostMessages = 50;
/// However often hosts ask: a birth has all values.
constexpr base::Milliseconds kBetweenBirths{1'000};
/// Sparkplug 3.0 does not define values; these are OPC's, which hosts use.
constexpr std::int32_t kGood = 192;
constexpr std::int32_t kStale = 500;
constexpr std::int32_t kBad = 0;

std::int32_t quality_of(Quality quality) {
    if (quality == Quality::good) return kGood;
    return quality == Quality::old ? kStale : kBad;
}

bool is_same(const PointValue& a, const PointValue& b) {
    return a.quality == b.quality && !(a.value < b.value) && !(b.value < a.value);
}

Metric named(std::string_view name, std::uint64_t alias, DataType type, Value value) {
    Metric metric;
    metric.name = std::string(name);
    metric.alias = alias;
    metric.type = type;
    metric.value = std::move(value);
    return metric;
}

bool is_alive(const faces::AxisImage& image, base::Instant now) {
    return image.number != 0 && now - image.taken <= faces::AxisModel::kOld;
}

}  // namespace

EdgeNode::EdgeNode(const Options& options, const faces::Axes& axes, faces::Bell& bell)
    : options_(options), store_(options.store) {
    for (faces::AxisModel* axis : axes) {
        Device& device = devices_.emplace_back();
        device.axis = axis;
        device.items = point_items(axis->scaling());
        device.points = device.items.size();
        if (options_.takes_anything()) device.client = axis->join(faces::Side::plant, "MQTT", bell);
    }
}

std::string EdgeNode::topic(std::string_view type, std::string_view device) const {
    return fmt::format("{}{}/{}/{}{}{}", kNamespace, options_.group, type, options_.node,
                       device.empty() ? "" : "/", device);
}

std::uint64_t EdgeNode::alias_of(std::size_t device, std::size_t metric) const {
    return kFirstAlias + kAliasesOfDevice * device + metric;
}

void EdgeNode::begin_session() {
    ++bd_seq_;
    host_is_online_ = false;
    wants_to_leave_ = false;
}

/// Without a seq, with the bdSeq of its birth (§6.4.9).
std::string EdgeNode::death_payload(std::uint64_t milliseconds) const {
    Metric metric;
    metric.name = "bdSeq";
    metric.timestamp = milliseconds;
    metric.value = std::int64_t{bd_seq_};
    return encode({.timestamp = milliseconds, .metrics = {metric}});
}

std::vector<std::string> EdgeNode::subscriptions() const {
    std::vector<std::string> topics{topic("NCMD"), topic("DCMD", "+")};
    if (!options_.primary_host.empty()) {
        topics.push_back(fmt::format("{}STATE/{}", kNamespace, options_.primary_host));
        topics.push_back("STATE/" + options_.primary_host);  // of hosts before Sparkplug 3.0
    }
    return topics;
}

/// A group or node may be called STATE, too.
bool EdgeNode::is_host_state(std::string_view topic) const {
    constexpr std::string_view kState = "STATE/";
    if (topic.starts_with(kNamespace)) topic.remove_prefix(kNamespace.size());
    return !options_.primary_host.empty() && topic.starts_with(kState) &&
           topic.substr(kState.size()) == options_.primary_host;
}

void EdgeNode::disconnected() {
    is_connected_ = false;
    is_born_ = false;
    for (Device& device : devices_) device.is_born = false;
    store_.restart();
}

bool EdgeNode::send(const Publish& publish, const std::string& to, std::vector<Metric> metrics,
                    std::uint64_t milliseconds) {
    if (!publish(to, encode({.timestamp = milliseconds, .metrics = std::move(metrics), .seq = seq_})))
        return false;
    ++seq_;
    return true;
}

void EdgeNode::bear_node(const Publish& publish, std::uint64_t milliseconds) {
    seq_ = 0;
    std::vector<Metric> metrics;
    metrics.push_back({.name = "bdSeq", .timestamp = milliseconds, .value = std::int64_t{bd_seq_}});
    metrics.push_back(named(kRebirth, kRebirthAlias, DataType::boolean, false));
    metrics.push_back(
        named(kDropped, kDroppedAlias, DataType::int64, static_cast<std::int64_t>(store_.dropped())));
    metrics.back().description =
        "values dropped since the start, while the broker or the primary host was away";
    metrics.push_back(named(kVersion, kVersionAlias, DataType::text, faces::program_version()));
    for (Metric& metric : metrics) metric.timestamp = milliseconds;
    is_born_ = send(publish, topic("NBIRTH"), std::move(metrics), milliseconds);
    told_dropped_ = store_.dropped();
    born_at_ = milliseconds;
    wants_rebirth_ = false;
    for (Device& device : devices_) device.is_born = false;
}

void EdgeNode::bear_device(std::size_t index, const Publish& publish, const Moment& moment) {
    Device& device = devices_[index];
    std::vector<Metric> metrics;
    for (std::size_t i = 0; i < device.last.size(); ++i) {
        const Item& item = device.items[i];
        Metric metric = named(item.name, alias_of(index, i), item.type, value_of(item, device.last[i]));
        metric.description = item.text;
        metric.unit = item.unit;
        metric.lowest = item.lowest;
        metric.highest = item.highest;
        metric.quality = quality_of(device.last[i].quality);
        metrics.push_back(std::move(metric));
    }
    for (std::size_t i = 0; i < options_.commands.size(); ++i)
        metrics.push_back(named(fmt::format("{}{}", kCommand, gw::name_of(options_.commands[i])),
                                alias_of(index, kCommandAlias + i), DataType::boolean, false));
    metrics.push_back(why_metric(index));
    for (Metric& result : result_metrics(index)) metrics.push_back(std::move(result));
    for (Metric& metric : metrics) metric.timestamp = moment.milliseconds;
    device.is_born =
        send(publish, topic("DBIRTH", device.axis->name()), std::move(metrics), moment.milliseconds);
}

std::vector<Metric> EdgeNode::result_metrics(std::size_t index) const {
    if (!options_.takes_anything()) return {};
    const Device& device = devices_[index];
    Metric last = named(kLast, alias_of(index, kLastAlias), DataType::text, device.command);
    last.description = "the last command, as it came";
    Metric result = named(kResult, alias_of(index, kResultAlias), DataType::int64, device.result);
    result.description = "how it ended: 0 done, else firmware/gateway/REGISTERS.md, Results";
    Metric text = named(kText, alias_of(index, kTextAlias), DataType::text, device.result_text);
    text.description = "the same in words";
    return {last, result, text};
}

Metric EdgeNode::why_metric(std::size_t index) const {
    const Device& device = devices_[index];
    Metric metric = named(kWhyText, alias_of(index, kWhyAlias), DataType::text, {});
    if (!device.why.empty()) metric.value = device.why;
    metric.description = "`why` in words";
    return metric;
}

/// Finds changes since the last call; the first call is for the birth.
void EdgeNode::look(std::size_t index, const Moment& moment) {
    Device& device = devices_[index];
    std::shared_ptr<const faces::Findings> why;
    const faces::AxisImage image = device.axis->image_with_why(moment.now, &why);
    if (!is_alive(image, moment.now)) return;
    const std::string text = why == nullptr ? std::string() : why->front().sentence;
    device.why_changed = device.why_changed || text != device.why;
    device.why = text;
    follow_set_points(device);
    const std::size_t known = device.last.size();
    device.last.resize(device.items.size());
    for (std::size_t i = 0; i < device.items.size(); ++i) {
        const PointValue value = device.items[i].take(image, moment.now);
        if (i < known && !is_same(value, device.last[i]))
            store_.push({.device = static_cast<std::uint16_t>(index),
                         .point = static_cast<std::uint16_t>(i),
                         .edition = device.edition,
                         .milliseconds = moment.milliseconds,
                         .value = value});
        device.last[i] = value;
    }
}

/// Another table or recipe changes the metrics, so the device is born again.
void EdgeNode::follow_set_points(Device& device) {
    const auto book = device.axis->set_points();
    if (device.book == book) return;
    const bool is_same = device.book && device.book->record_crc == book->record_crc &&
                         std::equal(book->recipes.begin(), book->recipes.end(), device.book->recipes.begin(),
                                    device.book->recipes.end(), [](const auto& one, const auto& other) {
                                        return one.number == other.number && one.name == other.name;
                                    });
    device.book = book;
    if (is_same) return;
    ++device.edition;
    device.is_born = false;
    device.items.resize(device.points);
    for (Item& item : set_point_items(book)) device.items.push_back(std::move(item));
    device.last.resize(std::min(device.last.size(), device.points));
}

/// Its item no longer exists.
bool EdgeNode::is_outdated(const Record& record) const {
    const Device& device = devices_[record.device];
    return record.point >= device.points && record.edition != device.edition;
}

Metric EdgeNode::metric_of(const Record& record) const {
    const Item& item = devices_[record.device].items[record.point];
    Metric metric;
    metric.alias = alias_of(record.device, record.point);
    metric.timestamp = record.milliseconds;
    metric.type = item.type;
    metric.is_historical = record.milliseconds <= born_at_;
    metric.value = value_of(item, record.value);
    metric.quality = quality_of(record.value.quality);
    return metric;
}

/// Messages of one device each, in the order of events.
void EdgeNode::flush(const Publish& publish, std::uint64_t milliseconds) {
    for (int i = 0; i < kMostMessages && store_.has_unsent(); ++i) {
        const std::size_t device = store_.next().device;
        // Its axis is dead, and its next birth will have the values; or the item no longer exists.
        if (!devices_[device].is_born || is_outdated(store_.next())) {
            store_.drop_next();
            continue;
        }
        std::vector<Metric> metrics;
        while (store_.has_unsent() && store_.next().device == device && !is_outdated(store_.next()) &&
               metrics.size() < kMostOfMessage) {
            metrics.push_back(metric_of(store_.next()));
            store_.note_sent();
        }
        const std::size_t count = metrics.size();
        if (send(publish, topic("DDATA", devices_[device].axis->name()), std::move(metrics), milliseconds))
            continue;
        store_.take_back(count);
        return;
    }
}

/// Result of the device's last command.
void EdgeNode::report(std::size_t index, const Publish& publish, const Moment& moment) {
    const std::uint64_t milliseconds = moment.milliseconds;
    Device& device = devices_[index];
    while (device.client) {
        const auto ended = device.client->take(moment.now);
        if (!ended) break;
        if (ended->id != device.command_id) continue;
        device.stop_waits = false;
        device.result = static_cast<std::int64_t>(ended->result);
        device.result_text = device.sets_values ? faces::describe_refusal(*device.axis->set_points(), *ended)
                                                : faces::describe(*ended);
        if (ended->result == Result::done) device.result_text = "done";
        device.result_changed = true;
    }
    if (!device.is_born) return;
    std::vector<Metric> metrics;
    if (device.result_changed) metrics = result_metrics(index);
    if (device.why_changed) metrics.push_back(why_metric(index));
    if (metrics.empty()) return;
    for (Metric& metric : metrics) {
        metric.name.clear();
        metric.description.clear();
        metric.timestamp = milliseconds;
    }
    const bool failed = !send(publish, topic("DDATA", device.axis->name()), std::move(metrics), milliseconds);
    device.result_changed = device.result_changed && failed;
    device.why_changed = device.why_changed && failed;
}

void EdgeNode::tick(const Moment& moment, const Publish& publish) {
    if (moment.now >= next_look_) {
        next_look_ = moment.now + options_.period;
        for (std::size_t i = 0; i < devices_.size(); ++i) look(i, moment);
    }
    for (Device& device : devices_) device.axis->want(moment.now);
    if (!may_publish() || wants_to_leave_) return;
    if (!is_born_ || (wants_rebirth_ && moment.now >= next_birth_)) {
        bear_node(publish, moment.milliseconds);
        next_birth_ = moment.now + kBetweenBirths;
    }
    for (std::size_t i = 0; is_born_ && i < devices_.size(); ++i) {
        Device& device = devices_[i];
        const faces::AxisImage image = device.axis->image(moment.now);
        const bool lives = is_alive(image, moment.now) && !device.last.empty();
        if (lives && !device.is_born) bear_device(i, publish, moment);
        report(i, publish, moment);
        if (!lives && device.is_born && !device.stop_waits)  // its answer would come from a dead device
            device.is_born = !send(publish, topic("DDEATH", device.axis->name()), {}, moment.milliseconds);
    }
    if (is_born_) flush(publish, moment.milliseconds);
    if (is_born_ && told_dropped_ != store_.dropped()) {
        Metric dropped;
        dropped.alias = kDroppedAlias;
        dropped.timestamp = moment.milliseconds;
        dropped.value = static_cast<std::int64_t>(store_.dropped());
        if (send(publish, topic("NDATA"), {dropped}, moment.milliseconds)) told_dropped_ = store_.dropped();
    }
}

/// {"online": true, "timestamp": ...} (§6.4.13), or ONLINE and OFFLINE of older hosts. An OFFLINE older than
/// the last ONLINE belongs to an earlier session.
void EdgeNode::take_host_state(std::string_view payload) {
    bool is_online = payload == "ONLINE";
    if (!is_online && payload != "OFFLINE") {
        const auto state = nlohmann::json::parse(payload, nullptr, false);
        if (!state.is_object() || !state.contains("online") || !state["online"].is_boolean()) return;
        const auto since = state.find("timestamp");
        const std::uint64_t timestamp =
            since != state.end() && since->is_number_unsigned() ? since->get<std::uint64_t>() : host_since_;
        if (timestamp < host_since_) return;
        host_since_ = timestamp;
        is_online = state["online"].get<bool>();
    }
    if (!is_online && host_is_online_) wants_to_leave_ = true;
    host_is_online_ = is_online;
}

}  // namespace nplc::mqtt
