#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "motor/motor.h"
#include "order_audit.h"
#include "sim/world.h"

namespace nplc::soak {

using sim::Time;

/// What was ordered against what the motor executed, at every moment: nothing that was not ordered, nothing
/// twice, in the order given, nothing later than kLate, and all that the driver reports as executed has been
/// executed. What the driver discards may have been on the line, but is never delivered later.
class OrderBook {
  public:
    /// Of what the driver dropped: the characters that the line's port still has.
    static constexpr Time kOnTheLine = std::chrono::milliseconds{100};
    /// A full queue with its resends takes less.
    static constexpr Time kLate = std::chrono::seconds{1};

    explicit OrderBook(const sim::World& world) : world_(world) {}

    void ordered(const sequencer::MotorOrder& order);
    void executed(const sim::Order& order);
    /// What a person's program asks for, and the gateway may refuse.
    void by_person(std::uint8_t reg, std::uint32_t value);
    /// After orders were executed: the driver's report of it.
    void settle();
    /// The gateway restarted: what was on its way may have been executed.
    void restart();
    /// The line changed characters in a way that no repeat shows: for a while what is executed is not judged.
    void excuse(Time until) { excused_until_ = std::max(excused_until_, until); }
    /// The motor was switched on: in the middle of a blind stop it takes the rest of it for commands
    /// (firmware/motor/README.md), until the next one.
    void switched_on() { switched_on_ = world_.now(); }

    /// Empty, or the first breach.
    bool has_open() const { return !open_.empty(); }
    const std::string& breach() const { return breach_; }
    std::uint64_t count() const { return matched_; }
    std::uint64_t excused() const { return excused_; }

  private:
    struct Entry {
        sim::SentOrder order;
        Time at{0};
        bool of_link = false;
        bool executed = false;
        std::optional<Time> dropped{};
    };

    Entry* find(const sim::SentOrder& order);
    bool is_part_of_blind_stop(const sim::SentOrder& order) const;
    void drop_last();
    void say(const std::string& what, const sim::SentOrder& order);
    bool is_excused() const { return world_.now() < excused_until_; }

    const sim::World& world_;
    std::deque<Entry> entries_;
    std::deque<sim::SentOrder> of_person_;
    std::size_t first_ = 0;         ///< the number of entries_.front()
    std::deque<std::size_t> open_;  ///< numbers of those that the driver has neither executed nor discarded
    std::size_t next_match_ = 0;    ///< what is executed next was ordered here or later
    std::size_t given_ = 0;
    motor::Counters seen_{};
    Time excused_until_{0};
    std::optional<Time> switched_on_{};
    std::uint64_t matched_ = 0;
    std::uint64_t excused_ = 0;
    std::string breach_;
};

}  // namespace nplc::soak
