#include "nanofleet/roll_out.h"

#include <fmt/format.h>

#include <algorithm>

#include "orders/pieces.h"
#include "orders/topics.h"

namespace nplc::nanofleet {
namespace {

using Kind = Outcome::Kind;
using orders::State;

constexpr std::size_t kStages = 3;

void end(Outcome& outcome, Kind kind, const std::string& text, std::uint64_t now) {
    outcome.kind = kind;
    outcome.text = text;
    outcome.ended_at = now;
}

}  // namespace

std::string_view name_of(Outcome::Kind kind) {
    switch (kind) {
        case Kind::waits:
            return "not ordered";
        case Kind::ordered:
            return "ordered";
        case Kind::done:
            return "done";
        case Kind::failed:
            return "failed";
        case Kind::silent:
            return "silent";
    }
    return "";
}

RollOut::RollOut(Plan plan) : plan_(std::move(plan)), wanted_(orders::hex(orders::sha256(plan_.artifact))) {
    for (const std::string& target : plan_.targets) outcomes_.push_back({.target = target});
    orders_.resize(outcomes_.size());
}

void RollOut::publish_pieces(const Publish& publish) const {
    const orders::Hash hash = orders::sha256(plan_.artifact);
    for (std::size_t i = 0; i < orders::pieces_of(plan_.artifact.size()); ++i) {
        const auto piece = orders::piece_of(plan_.artifact, i);
        publish(orders::piece_topic(hash, i), {piece.begin(), piece.end()});
    }
}

std::size_t RollOut::count(Outcome::Kind kind) const {
    return static_cast<std::size_t>(std::count_if(
        outcomes_.begin(), outcomes_.end(), [kind](const Outcome& outcome) { return outcome.kind == kind; }));
}

/// One, a tenth, all, without the silent ones.
std::size_t RollOut::end_of_stage() const {
    const std::size_t all = outcomes_.size();
    if (stage_ + 1 >= kStages) return all;
    const std::size_t wanted = stage_ == 0 ? 1 : std::max<std::size_t>((all + 9) / 10, 1);
    std::size_t end = 0;
    for (std::size_t heard = 0; end < all && heard < wanted; ++end) {
        if (outcomes_[end].kind != Kind::silent) ++heard;
    }
    return end;
}

bool RollOut::too_many_failed() const {
    const std::size_t failed = count(Kind::failed);
    const std::size_t ordered = failed + count(Kind::done) + count(Kind::ordered);
    return 100.0 * static_cast<double>(failed) > plan_.most_failures * static_cast<double>(ordered);
}

void RollOut::look(const Roster& roster, std::uint64_t now, const Publish& publish) {
    if (is_over_) return;
    for (Outcome& outcome : outcomes_) {
        if (outcome.kind == Kind::ordered) follow(outcome, roster.of(outcome.target), now);
    }
    was_stopped_ = was_stopped_ || too_many_failed();
    const auto end = outcomes_.begin() + static_cast<std::ptrdiff_t>(end_of_stage());
    for (auto outcome = outcomes_.begin(); outcome != end && !was_stopped_; ++outcome) {
        if (outcome->kind != Kind::waits) continue;
        begin(*outcome, roster.of(outcome->target), now, publish);
        was_stopped_ = too_many_failed();
    }
    if (count(Kind::ordered) != 0) return;
    const bool is_last = stage_ + 1 >= kStages;
    is_over_ = was_stopped_ || (is_last && count(Kind::waits) == 0);
    // Silent gateways do not count: the stage gets others instead
    if (!is_last &&
        std::none_of(outcomes_.begin(), outcomes_.begin() + static_cast<std::ptrdiff_t>(end_of_stage()),
                     [](const Outcome& one) { return one.kind == Kind::waits; }))
        ++stage_;
}

/// An existing order for the same table, from any client, is followed instead of repeated.
void RollOut::begin(Outcome& outcome, const Heard& heard, std::uint64_t now, const Publish& publish) {
    const Standing standing = judge(heard, wanted_, now, plan_.oldest);
    if (standing.kind == Standing::Kind::silent) return end(outcome, Kind::silent, standing.text, now);
    const orders::Report& report = *heard.report;
    const auto before = orders::read_order(heard.order);
    const bool is_same = before.order && orders::hex(before.order->order.sha256) == wanted_;
    if (is_same) {
        const std::string hash = orders::hex(orders::sha256(heard.order));
        const bool is_taken = report.order_sha256 == hash;
        const bool has_failed =
            is_taken && (report.state == State::failed || report.state == State::rolled_back);
        const bool comes_soon = !is_taken && before.order->order.counter > report.counter;
        if (is_taken ? !has_failed || !plan_.again : comes_soon) {
            outcome.kind = Kind::ordered;
            outcome.ordered_at = now;
            outcome.counter = before.order->order.counter;
            orders_[static_cast<std::size_t>(&outcome - outcomes_.data())] = hash;
            return follow(outcome, heard, now);
        }
    }
    if (standing.kind == Standing::Kind::as_wanted && orders::is_final(report.state))
        return end(outcome, Kind::done, "it runs already", now);
    order(outcome, heard, now, publish);
}

void RollOut::order(Outcome& outcome, const Heard& heard, std::uint64_t now, const Publish& publish) {
    outcome.counter = heard.report->counter + 1;
    if (const auto before = orders::read_order(heard.order); before.order)
        outcome.counter = std::max(outcome.counter, before.order->order.counter + 1);
    const orders::Order order{.target = outcome.target,
                              .counter = outcome.counter,
                              .name = plan_.name,
                              .sha256 = orders::sha256(plan_.artifact),
                              .bytes = static_cast<std::uint32_t>(plan_.artifact.size())};
    const std::string text = orders::write_order(order, plan_.key.seed);
    orders_[static_cast<std::size_t>(&outcome - outcomes_.data())] = orders::hex(orders::sha256(text));
    outcome.kind = Kind::ordered;
    outcome.ordered_at = now;
    publish(orders::order_topic(outcome.target), text);
}

void RollOut::follow(Outcome& outcome, const Heard& heard, std::uint64_t now) const {
    if (!heard.report) return;
    const orders::Report& report = *heard.report;
    const bool is_ours =
        report.order_sha256 == orders_[static_cast<std::size_t>(&outcome - outcomes_.data())];
    outcome.text = is_ours ? fmt::format("{}{}{}", orders::name_of(report.state),
                                         report.text.empty() ? "" : ": ", report.text)
                           : "has not taken the order";
    if (is_ours && report.state == State::confirmed && report.table_sha256 == wanted_)
        return end(outcome, Kind::done, outcome.text, now);
    if (is_ours && orders::is_final(report.state)) return end(outcome, Kind::failed, outcome.text, now);
    if (!is_ours && report.counter >= outcome.counter)
        return end(outcome, Kind::failed, fmt::format("somebody else has given order {}", report.counter),
                   now);
    const bool is_refused = !is_ours && report.refused >= outcome.ordered_at && !report.refusal.empty();
    if (is_refused) return end(outcome, Kind::failed, report.refusal, now);
    if (now - outcome.ordered_at > plan_.patience)
        end(outcome, Kind::failed,
            fmt::format("not done within {} s: {}", plan_.patience / 1000, outcome.text), now);
}

}  // namespace nplc::nanofleet
