#include "order_audit.h"

#include <algorithm>

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

void keep(std::vector<SentOrder>& list, const SentOrder& order) {
    if (!concerns_the_link_only(order)) list.push_back(order);
}

void cut(std::vector<SentOrder>& list) {
    if (list.size() > kMostOrders)
        list.erase(list.begin(), list.end() - static_cast<std::ptrdiff_t>(kMostOrders));
}

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

}  // namespace

OrderAudit audit(const std::vector<SentOrder>& ordered, const std::deque<Order>& executed,
                 fastmac::RegisterCode code) {
    std::vector<SentOrder> wanted;
    std::vector<SentOrder> done;
    for (const SentOrder& order : ordered) keep(wanted, order);
    for (const Order& order : executed) keep(done, as_sent(order, code));
    cut(wanted);
    cut(done);
    const auto lengths = common_lengths(wanted, done);
    OrderAudit result;
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < wanted.size() || j < done.size()) {
        if (i < wanted.size() && j < done.size() && wanted[i] == done[j]) {
            ++i;
            ++j;
        } else if (j == done.size() || (i < wanted.size() && lengths[i + 1][j] >= lengths[i][j + 1])) {
            result.missing.push_back(wanted[i++]);
        } else {
            result.unordered.push_back(done[j++]);
        }
    }
    return result;
}

}  // namespace nplc::sim
