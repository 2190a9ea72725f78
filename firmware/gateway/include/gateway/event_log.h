#pragma once

#include <array>
#include <cstdint>

#include "gateway/uptime.h"
#include "gateway/vocabulary.h"
#include "registers/gateway.h"

namespace nplc::gateway {

/// Uptime and the latest events. Entry number n, counted from 0, is in slot n modulo the number of slots.
class EventLog {
  public:
    static constexpr std::size_t kSlots = registers::gateway::kLogEntries;

    struct Entry {
        std::uint32_t milliseconds = 0;  ///< of uptime
        std::uint8_t event = 0;          ///< a SafeReason below 16, else an Event
        std::uint8_t step = 0;
        std::uint16_t detail = 0;
    };

    void advance(base::Instant now) { uptime_.advance(now); }
    std::uint32_t uptime() const { return uptime_.milliseconds(); }
    /// When uptime() will be `more` than now.
    base::Instant uptime_in(std::uint32_t more) const { return uptime_.in(more); }

    void add(std::uint8_t event, std::uint8_t step, std::uint16_t detail) {
        entries_[count_ % kSlots] = {uptime(), event, step, detail};
        ++count_;
    }
    std::uint32_t count() const { return count_; }
    const Entry& slot(std::size_t index) const { return entries_[index]; }
    void clear() {
        entries_ = {};
        count_ = 0;
    }

  private:
    std::array<Entry, kSlots> entries_{};
    std::uint32_t count_ = 0;
    Uptime uptime_;
};

}  // namespace nplc::gateway
