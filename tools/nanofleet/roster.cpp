#include "nanofleet/roster.h"

#include <fmt/format.h>

#include "orders/topics.h"

namespace nplc::nanofleet {

void Roster::take(std::string_view topic, std::string_view payload) {
    if (const auto target = orders::target_of(topic, "order")) heard_[*target].order = payload;
    const auto target = orders::target_of(topic, "report");
    if (!target) return;
    auto report = orders::read_report(payload);
    if (report && report->target == *target) heard_[*target].report = std::move(report);
}

const Heard& Roster::of(const std::string& target) const {
    static const Heard kNothing;
    const auto place = heard_.find(target);
    return place == heard_.end() ? kNothing : place->second;
}

std::vector<std::string> Roster::topics(const std::vector<std::string>& targets) {
    std::vector<std::string> topics;
    for (const std::string& target : targets) {
        topics.push_back(orders::report_topic(target));
        topics.push_back(orders::order_topic(target));
    }
    return topics;
}

std::string_view name_of(Standing::Kind kind) {
    switch (kind) {
        case Standing::Kind::as_wanted:
            return "as wanted";
        case Standing::Kind::under_way:
            return "under way";
        case Standing::Kind::differs:
            return "differs";
        case Standing::Kind::silent:
            return "silent";
    }
    return "";
}

Standing judge(const Heard& heard, std::string_view wanted, std::uint64_t now, std::uint64_t oldest) {
    Standing standing;
    if (!heard.report) {
        standing.text = "it has never reported";
        return standing;
    }
    const orders::Report& report = *heard.report;
    standing.contact = report.time;
    if (report.time + oldest < now) {
        standing.text = fmt::format("it has not reported for {} s", (now - report.time) / 1000);
        return standing;
    }
    const bool is_it = report.table_sha256 == wanted;
    standing.kind = is_it ? Standing::Kind::as_wanted : Standing::Kind::differs;
    if (report.state != orders::State::none)
        standing.text = fmt::format("order {}: {}{}{}", report.counter, orders::name_of(report.state),
                                    report.text.empty() ? "" : ": ", report.text);
    const auto order = orders::read_order(heard.order);
    const bool is_ordered = order.order && orders::hex(order.order->order.sha256) == wanted;
    const bool is_taken = report.order_sha256 == orders::hex(orders::sha256(heard.order));
    if (is_ordered && is_taken && !orders::is_final(report.state)) standing.kind = Standing::Kind::under_way;
    return standing;
}

}  // namespace nplc::nanofleet
