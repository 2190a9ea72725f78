#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "protocol/fastmac.h"
#include "sim/fastmac_slave.h"
#include "sim/snapshot.h"

namespace nplc::sim {

/// The order as the sequence gives it. `code`: the register code with which the motor executes its commands.
SentOrder as_sent(const Order& order, protocol::fastmac::RegisterCode code);
/// NOP, 0Ah, 0Bh, 13h, 1Dh, 1Eh, 1Fh; and MODE_REG := 0, which the gateway sends by itself to stop the motor.
bool concerns_the_link_only(const SentOrder& order);

/// Number of orders, and the first of them.
struct OrderList {
    static constexpr std::size_t kKept = 8;

    std::vector<SentOrder> first;
    std::size_t count = 0;

    void add(const SentOrder& order);
    bool empty() const { return count == 0; }
};

/// The sequence's orders compared with those executed by the motor. Ignored on both sides:
/// concerns_the_link_only().
struct OrderAudit {
    OrderList missing;    ///< ordered and not executed
    OrderList under_way;  ///< ordered and not executed yet
    OrderList unordered;  ///< executed and not ordered
};

/// Compares both incrementally: the longest common subsequence. Equal orders at the front of both are removed
/// at once. After a difference up to kMostWaiting of both together are kept; then the older half is judged,
/// considering the newer one. `on_their_way`: the numbers, ascending from 0, of the orders that the driver
/// has not finished.
class OrderAuditor {
  public:
    static constexpr std::size_t kMostWaiting = 1024;
    using OnTheirWay = std::deque<std::size_t>;

    /// `code`: the register code with which the motor executes its commands; the sequence's is the format
    /// list's.
    explicit OrderAuditor(protocol::fastmac::RegisterCode code) : code_(code) {}

    void ordered(const SentOrder& order);
    void executed(const Order& order);
    /// To be called after them.
    void settle(const OnTheirWay& on_their_way);
    /// Judges all remaining orders.
    OrderAudit finish(const OnTheirWay& on_their_way);

  private:
    struct Wanted {
        SentOrder order;
        std::size_t number;
    };

    void drop_equal_fronts();
    void judge(const OnTheirWay& on_their_way, std::size_t count);

    protocol::fastmac::RegisterCode code_;
    std::size_t numbers_ = 0;
    std::deque<Wanted> wanted_;
    std::deque<SentOrder> done_;
    OrderAudit found_;
};

}  // namespace nplc::sim
