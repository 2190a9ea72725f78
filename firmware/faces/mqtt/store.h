#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "faces/points.h"

namespace nplc::mqtt {

/// A changed value.
struct Record {
    std::uint16_t device = 0;
    std::uint16_t point = 0;         ///< its index in the device's items
    std::uint16_t edition = 0;       ///< of the device's items
    std::uint64_t milliseconds = 0;  ///< since 1970
    faces::PointValue value{};
};

/// Changes that the broker is not known to have received, in order. When full, the oldest is dropped and
/// counted.
class Store {
  public:
    explicit Store(std::size_t most) : most_(most) {}

    void push(const Record& record) {
        if (records_.size() >= most_) {
            records_.pop_front();
            forget_first();
        }
        records_.push_back(record);
    }
    bool has_unsent() const { return sent_ < records_.size(); }
    const Record& next() const { return records_[sent_]; }
    void drop_next() {
        records_.erase(records_.begin() + static_cast<std::ptrdiff_t>(sent_));
        ++dropped_;
    }
    void note_sent() { ++sent_; }
    /// The connection did not accept the last ones.
    void take_back(std::size_t count) { sent_ -= count; }
    /// Marks everything sent so far as covered by the pending query; the answer confirms its arrival.
    void ask() {
        asked_ = sent_;
        forgotten_asked_ = forgotten_;
    }
    bool wants_asking() const { return sent_ != 0 || forgotten_ != 0; }
    void confirm() {
        records_.erase(records_.begin(), records_.begin() + static_cast<std::ptrdiff_t>(asked_));
        sent_ -= asked_;
        forgotten_ -= forgotten_asked_;
        asked_ = forgotten_asked_ = 0;
    }
    /// The connection was lost: unconfirmed values are sent again.
    void restart() {
        dropped_ += forgotten_;
        sent_ = asked_ = forgotten_ = forgotten_asked_ = 0;
    }
    std::uint64_t dropped() const { return dropped_; }
    std::size_t size() const { return records_.size(); }

  private:
    /// A sent value is lost only if the connection is.
    void forget_first() {
        if (sent_ == 0) {
            ++dropped_;
            return;
        }
        --sent_;
        ++forgotten_;
        if (asked_ == 0) return;
        --asked_;
        ++forgotten_asked_;
    }

    std::size_t most_;
    std::deque<Record> records_;
    std::size_t sent_ = 0;             ///< number of sent ones, from the oldest
    std::size_t asked_ = 0;            ///< of those, covered by the query
    std::size_t forgotten_ = 0;        ///< sent, not confirmed, and no longer stored
    std::size_t forgotten_asked_ = 0;  ///< of those, covered by the query
    std::uint64_t dropped_ = 0;
};

}  // namespace nplc::mqtt
