#include "order_node.h"

#include <fmt/format.h>

#include <utility>

#include "orders/topics.h"

namespace nplc::mqtt {
namespace {

/// Pieces that were published while the broker was offline may come later.
constexpr base::Milliseconds kAskAgain{30'000};
constexpr base::Milliseconds kBetweenReports{500};

}  // namespace

OrderNode::OrderNode(const Options& options, const faces::Axes& axes, faces::Bell& bell)
    : report_every_(options.orders.report_every) {
    if (!options.orders.takes_orders()) return;
    for (faces::AxisModel* axis : axes) {
        const std::string target = fmt::format("{}/{}/{}", options.group, options.node, axis->name());
        parts_.push_back({.deployment = std::make_unique<deployment::Deployment>(options.orders, target,
                                                                                 *axis, bell, options.tell)});
    }
}

void OrderNode::connected() {
    is_connected_ = true;
    is_subscribed_ = false;
    asked_.clear();
    for (Part& part : parts_) part.was_told = false;
}

bool OrderNode::receive(std::string_view topic, std::string_view payload, const deployment::Moment& moment) {
    if (!topic.starts_with(orders::kTopics)) return false;
    if (const auto piece = orders::read_piece_topic(topic)) {
        const std::span bytes(reinterpret_cast<const std::uint8_t*>(payload.data()), payload.size());
        for (Part& part : parts_) part.deployment->take_piece(piece->hash, piece->number, bytes);
        return true;
    }
    const auto target = orders::target_of(topic, "order");
    for (Part& part : parts_) {
        if (target && *target == part.deployment->target()) part.deployment->take_order(payload, moment);
    }
    return true;
}

void OrderNode::tick(const deployment::Moment& moment, const Link& link) {
    for (Part& part : parts_) part.deployment->tick(moment);
    if (!is_connected_ || parts_.empty()) return;
    if (!is_subscribed_) {
        is_subscribed_ = true;
        for (const Part& part : parts_)
            is_subscribed_ = link.subscribe(orders::order_topic(part.deployment->target())) && is_subscribed_;
    }
    follow_wanted(moment, link);
    for (Part& part : parts_) tell(part, moment, link);
}

void OrderNode::follow_wanted(const deployment::Moment& moment, const Link& link) {
    std::map<std::string, base::Instant> wanted;
    for (const Part& part : parts_) {
        const orders::Hash* hash = part.deployment->wanted();
        if (hash == nullptr) continue;
        const std::string topic = orders::pieces_topic(*hash);
        const auto asked = asked_.find(topic);
        const bool is_asked = asked != asked_.end() && moment.now - asked->second < kAskAgain;
        if (is_asked || link.subscribe(topic)) wanted[topic] = is_asked ? asked->second : moment.now;
    }
    for (const auto& [topic, when] : asked_) {
        if (!wanted.contains(topic)) link.unsubscribe(topic);
    }
    asked_ = std::move(wanted);
}

/// On changes, and periodically, so that a silent axis is noticed.
void OrderNode::tell(Part& part, const deployment::Moment& moment, const Link& link) const {
    const base::Microseconds age = moment.now - part.told_at;
    if (part.was_told && age < kBetweenReports) return;
    auto report = part.deployment->report();
    if (!report || (part.was_told && *report == part.told && age < report_every_)) return;
    part.told = *report;
    report->time = moment.milliseconds;
    part.was_told =
        link.publish(orders::report_topic(part.deployment->target()), orders::write_report(*report));
    part.told_at = moment.now;
}

}  // namespace nplc::mqtt
