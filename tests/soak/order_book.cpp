#include "order_book.h"

#include <fmt/format.h>

#include <algorithm>

namespace nplc::soak {

void OrderBook::say(const std::string& what, const sim::SentOrder& order) {
    if (breach_.empty())
        breach_ = fmt::format("{}: {}", what, sim::in_words(order, registers::Model::mac140));
}

/// Called when the driver has it. While the link delivers it was not this one that was discarded.
void OrderBook::ordered(const sequencer::MotorOrder& order) {
    const sim::SentOrder sent{order.is_register_write, order.command, order.reg, order.value};
    if (motor::link_is_usable(world_.driver().link())) settle();
    entries_.push_back({sent, world_.now(), sim::concerns_the_link_only(sent)});
    open_.push_back(given_++);
}

/// Those that are on their way come first; what the driver has dropped may just have been on the line.
OrderBook::Entry* OrderBook::find(const sim::SentOrder& order) {
    for (const bool dropped : {false, true}) {
        for (std::size_t number = dropped ? first_ : std::max(next_match_, first_); number < given_;
             ++number) {
            Entry& entry = entries_[number - first_];
            if (entry.of_link || entry.executed || entry.order != order) continue;
            if (dropped ? !entry.dropped || world_.now() - *entry.dropped > kOnTheLine
                        : entry.dropped.has_value())
                continue;
            if (!dropped) next_match_ = number + 1;
            return &entry;
        }
    }
    return nullptr;
}

/// The bytes 00h and 02h of a write of MODE_REG are INIT(P1) and INIT(P3).
bool OrderBook::is_part_of_blind_stop(const sim::SentOrder& order) const {
    constexpr Time kUntilTheNext = std::chrono::milliseconds{60};
    return switched_on_ && world_.now() - *switched_on_ < kUntilTheNext &&
           !motor::link_is_usable(world_.driver().link()) && !order.is_register_write &&
           (order.command == 0x00 || order.command == 0x02);
}

void OrderBook::executed(const sim::Order& order) {
    const sim::SentOrder sent = sim::as_sent(order, protocol::fastmac::RegisterCode::format_list);
    if (sim::concerns_the_link_only(sent)) return;
    if (Entry* const entry = find(sent)) {
        if (world_.now() - entry->at > kLate && !is_excused())
            say("executed more than 1 s after it was ordered", sent);
        entry->executed = true;
        ++matched_;
    } else if (const auto of_person = std::ranges::find(of_person_, sent); of_person != of_person_.end()) {
        of_person_.erase(of_person);
    } else if (is_excused() || is_part_of_blind_stop(sent)) {
        ++excused_;
    } else {
        say("executed, and not ordered in the last seconds", sent);
    }
}

void OrderBook::by_person(std::uint8_t reg, std::uint32_t value) {
    constexpr std::size_t kMost = 16;
    of_person_.push_back({.is_register_write = true, .reg = reg, .value = value});
    if (of_person_.size() > kMost) of_person_.pop_front();
}

void OrderBook::drop_last() {
    entries_[open_.back() - first_].dropped = world_.now();
    open_.pop_back();
}

/// The driver executes in the order given, and drops from the end.
void OrderBook::settle() {
    const motor::Counters counters = world_.driver().counters();
    for (; seen_.orders != counters.orders && !open_.empty(); ++seen_.orders) {
        const std::size_t number = open_.front();
        open_.pop_front();
        const Entry& entry = entries_[number - first_];
        if (entry.of_link || entry.executed) continue;
        if (is_excused()) {
            ++excused_;
        } else {
            say("said to be executed, and the motor did not", entry.order);
        }
    }
    for (; seen_.discarded != counters.discarded && !open_.empty(); ++seen_.discarded) drop_last();
    seen_ = counters;
    const std::size_t kept = open_.empty() ? given_ : open_.front();
    while (first_ < kept && world_.now() - entries_.front().at > 3 * kLate) {
        entries_.pop_front();
        ++first_;
    }
}

void OrderBook::restart() {
    seen_ = world_.driver().counters();
    while (!open_.empty()) drop_last();
}

}  // namespace nplc::soak
