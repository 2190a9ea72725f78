#include "order_audit.h"

#include <algorithm>

#include "registers/mac.h"

namespace nplc::sim {

namespace fastmac = protocol::fastmac;

namespace {

/// Lengths of the longest common subsequence of the wanted orders from i on and the executed ones from j on.
class CommonLengths {
  public:
    template <class Same>
    CommonLengths(std::size_t wanted, std::size_t done, Same same)
        : columns_(done + 1), lengths_((wanted + 1) * columns_) {
        for (std::size_t i = wanted; i-- > 0;) {
            for (std::size_t j = done; j-- > 0;) {
                at(i, j) = same(i, j) ? static_cast<std::uint16_t>(at(i + 1, j + 1) + 1)
                                      : std::max(at(i + 1, j), at(i, j + 1));
            }
        }
    }
    std::uint16_t& at(std::size_t i, std::size_t j) { return lengths_[i * columns_ + j]; }

  private:
    std::size_t columns_;
    std::vector<std::uint16_t> lengths_;
};

}  // namespace

bool concerns_the_link_only(const SentOrder& order) {
    using fastmac::Number;
    if (order.is_register_write) return order.reg == registers::MODE_REG && order.value == 0;
    const auto command = fastmac::decode_command(order.command);
    if (command.mode != protocol::fastmac::Mode::command) return false;
    switch (static_cast<Number>(command.number)) {
        case Number::nop:
        case Number::rapid_communication:
        case Number::safe_communication:
        case Number::transmit_slowly:
        case Number::transmit_address:
        case Number::use_fastmac:
        case Number::use_flexmac:
            return true;
        default:
            return false;
    }
}

SentOrder as_sent(const Order& order, fastmac::RegisterCode code) {
    if (!order.flexmac)
        return {.command = fastmac::encode_command(fastmac::decode_command(order.command, code))};
    return {.is_register_write = true, .reg = order.reg, .value = order.message.value};
}

void OrderList::add(const SentOrder& order) {
    if (first.size() < kKept) first.push_back(order);
    ++count;
}

void OrderAuditor::ordered(const SentOrder& order) {
    const std::size_t number = numbers_++;
    if (concerns_the_link_only(order)) return;
    wanted_.push_back({order, number});
    drop_equal_fronts();
}

void OrderAuditor::executed(const Order& order) {
    const SentOrder sent = as_sent(order, code_);
    if (concerns_the_link_only(sent)) return;
    done_.push_back(sent);
    drop_equal_fronts();
}

void OrderAuditor::drop_equal_fronts() {
    while (!wanted_.empty() && !done_.empty() && wanted_.front().order == done_.front()) {
        wanted_.pop_front();
        done_.pop_front();
    }
}

void OrderAuditor::settle(const OnTheirWay& on_their_way) {
    const std::size_t waiting = wanted_.size() + done_.size();
    if (waiting >= kMostWaiting) judge(on_their_way, waiting / 2);
}

OrderAudit OrderAuditor::finish(const OnTheirWay& on_their_way) {
    judge(on_their_way, wanted_.size() + done_.size());
    return found_;
}

/// Judges at least this many of both together.
void OrderAuditor::judge(const OnTheirWay& on_their_way, std::size_t count) {
    const bool at_the_end = count == wanted_.size() + done_.size();
    const auto same = [&](std::size_t i, std::size_t j) { return wanted_[i].order == done_[j]; };
    CommonLengths lengths(wanted_.size(), done_.size(), same);
    std::size_t i = 0;
    std::size_t j = 0;
    while (i + j < count) {
        const bool has_wanted = i < wanted_.size();
        const bool has_done = j < done_.size();
        if (has_wanted && has_done && same(i, j)) {
            ++i;
            ++j;
            continue;
        }
        const int preference = has_wanted && has_done ? lengths.at(i + 1, j) - lengths.at(i, j + 1) : 0;
        const bool is_under_way =
            has_wanted && std::binary_search(on_their_way.begin(), on_their_way.end(), wanted_[i].number);
        // An order in progress may still be executed for as long as possible.
        const bool waits = is_under_way && !at_the_end && preference == 0;
        if (waits && !has_done) break;
        if (has_done && (!has_wanted || preference < 0 || waits)) {
            found_.unordered.add(done_[j++]);
        } else {
            (is_under_way && at_the_end ? found_.under_way : found_.missing).add(wanted_[i++].order);
        }
    }
    wanted_.erase(wanted_.begin(), wanted_.begin() + static_cast<std::ptrdiff_t>(i));
    done_.erase(done_.begin(), done_.begin() + static_cast<std::ptrdiff_t>(j));
    drop_equal_fronts();
}

}  // namespace nplc::sim
