#include "order_audit.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "registers/mac.h"

namespace nplc::sim {
namespace {

namespace fastmac = protocol::fastmac;

/// Alignment costs the product of both lengths; beyond this only the last orders are compared.
constexpr std::size_t kMostOrders = 4000;

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

/// What is compared of a list of orders.
struct Compared {
    std::vector<SentOrder> orders;
    std::vector<bool> under_way;

    void keep(const SentOrder& order, bool is_under_way = false) {
        if (concerns_the_link_only(order)) return;
        orders.push_back(order);
        under_way.push_back(is_under_way);
    }
    void cut() {
        if (orders.size() <= kMostOrders) return;
        const auto excess = static_cast<std::ptrdiff_t>(orders.size() - kMostOrders);
        orders.erase(orders.begin(), orders.begin() + excess);
        under_way.erase(under_way.begin(), under_way.begin() + excess);
    }
};

/// lengths[i][j]: the longest common subsequence of a from i and b from j.
std::vector<std::vector<std::uint16_t>> common_lengths(const std::vector<SentOrder>& a,
                                                       const std::vector<SentOrder>& b) {
    std::vector<std::vector<std::uint16_t>> lengths(a.size() + 1, std::vector<std::uint16_t>(b.size() + 1));
    for (std::size_t i = a.size(); i-- > 0;) {
        for (std::size_t j = b.size(); j-- > 0;) {
            lengths[i][j] = a[i] == b[j] ? static_cast<std::uint16_t>(lengths[i + 1][j + 1] + 1)
                                         : std::max(lengths[i + 1][j], lengths[i][j + 1]);
        }
    }
    return lengths;
}

void not_executed(const Compared& wanted, std::size_t i, OrderAudit& result) {
    (wanted.under_way[i] ? result.under_way : result.missing).push_back(wanted.orders[i]);
}

/// The common case, at no cost however long the lists are: everything executed was ordered, in that order.
std::optional<OrderAudit> with_nothing_unordered(const Compared& wanted, const Compared& done) {
    OrderAudit result;
    std::size_t j = 0;
    for (std::size_t i = 0; i < wanted.orders.size(); ++i) {
        if (j < done.orders.size() && wanted.orders[i] == done.orders[j]) {
            ++j;
        } else {
            not_executed(wanted, i, result);
        }
    }
    if (j != done.orders.size()) return std::nullopt;
    return result;
}

}  // namespace

OrderAudit audit(const std::vector<SentOrder>& ordered, const std::deque<Order>& executed,
                 const std::deque<std::size_t>& on_their_way, fastmac::RegisterCode code) {
    Compared wanted;
    Compared done;
    for (std::size_t i = 0; i < ordered.size(); ++i) {
        wanted.keep(ordered[i], std::binary_search(on_their_way.begin(), on_their_way.end(), i));
    }
    for (const Order& order : executed) done.keep(as_sent(order, code));
    if (auto result = with_nothing_unordered(wanted, done)) return *std::move(result);
    wanted.cut();
    done.cut();
    const auto lengths = common_lengths(wanted.orders, done.orders);
    OrderAudit result;
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < wanted.orders.size() || j < done.orders.size()) {
        const bool both = i < wanted.orders.size() && j < done.orders.size();
        if (both && wanted.orders[i] == done.orders[j]) {
            ++i;
            ++j;
        } else if (j == done.orders.size() || (both && lengths[i + 1][j] >= lengths[i][j + 1])) {
            not_executed(wanted, i++, result);
        } else {
            result.unordered.push_back(done.orders[j++]);
        }
    }
    return result;
}

}  // namespace nplc::sim
