#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "protocol/fastmac.h"
#include "sim/fastmac_slave.h"
#include "sim/snapshot.h"

namespace nplc::sim {

/// As the sequence gives it. `code`: the register code that the motor executes its commands by.
SentOrder as_sent(const Order& order, protocol::fastmac::RegisterCode code);
/// NOP, 0Ah, 0Bh, 13h, 1Dh, 1Eh, 1Fh; and MODE_REG := 0, with which the gateway stops the motor by itself.
bool concerns_the_link_only(const SentOrder& order);

/// How many, and the first of them.
struct OrderList {
    static constexpr std::size_t kKept = 8;

    std::vector<SentOrder> first;
    std::size_t count = 0;

    void add(const SentOrder& order);
    bool empty() const { return count == 0; }
};

/// What the sequence ordered against what the motor executed. Left out on both sides: what
/// concerns_the_link_only().
struct OrderAudit {
    OrderList missing;    ///< ordered and not executed
    OrderList under_way;  ///< ordered and not executed yet
    OrderList unordered;  ///< executed and not ordered
};

/// Compares while both go on: the longest common subsequence. Equal orders at the front of both are done with
/// at once. Behind a difference up to kMostWaiting of both together are kept; then the older half is judged,
/// in the light of the newer one. `on_their_way`: the numbers, ascending, of what the driver has not
/// finished, of the orders in turn, from 0.
class OrderAuditor {
  public:
    static constexpr std::size_t kMostWaiting = 1024;
    using OnTheirWay = std::deque<std::size_t>;

    /// `code`: the register code that the motor executes its commands by; the sequence's is the format
    /// list's.
    explicit OrderAuditor(protocol::fastmac::RegisterCode code) : code_(code) {}

    void ordered(const SentOrder& order);
    void executed(const Order& order);
    /// To be called after them.
    void settle(const OnTheirWay& on_their_way);
    /// Judges all that is left.
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
