#pragma once

#include "base/ring.h"
#include "motor/motor.h"

namespace nplc::motor {

/// A driver's orders: the queued ones, the one in execution, and the counters.
class OrderQueue {
  public:
    bool empty() const { return waiting_.empty(); }
    bool full() const { return waiting_.full(); }
    const Order& front() const { return waiting_.front(); }
    /// Discarded unless the link delivers.
    void push(const Order& order, bool delivers) {
        if (!delivers || !waiting_.push(order)) ++discarded_;
    }

    /// Moves the first order into execution. Needs !empty().
    const Order& begin() {
        current_ = waiting_.front();
        waiting_.pop();
        executing_ = true;
        return current_;
    }
    bool is_executing() const { return executing_; }
    const Order& current() const { return current_; }
    void end() {
        if (executing_) ++executed_;
        executing_ = false;
    }

    void discard_waiting() {
        discarded_ += static_cast<std::uint32_t>(waiting_.size());
        waiting_.clear();
    }
    void discard_all() {
        discard_waiting();
        if (executing_) ++discarded_;
        executing_ = false;
    }

    void count(Counters& counters) const {
        counters.orders = executed_;
        counters.discarded = discarded_;
    }

  private:
    bool executing_ = false;
    Order current_;
    std::uint32_t executed_ = 0;
    std::uint32_t discarded_ = 0;
    base::Ring<Order, 8> waiting_;
};

}  // namespace nplc::motor
