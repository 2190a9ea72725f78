#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "base/time.h"

namespace nplc::causes {

/// Values by number, as the registers' own width and sign have them.
class Snapshot {
  public:
    explicit Snapshot(base::Instant time = {}) : time_(time) {}

    /// When the last of them came.
    base::Instant time() const { return time_; }
    std::optional<std::int64_t> find(std::uint8_t number) const {
        const auto found = values_.find(number);
        return found == values_.end() ? std::nullopt : std::optional(found->second);
    }
    /// 0 if it was not read.
    std::int64_t at(std::uint8_t number) const { return find(number).value_or(0); }
    void set(std::uint8_t number, std::int64_t value, base::Instant time) {
        values_[number] = value;
        time_ = time;
    }
    const std::map<std::uint8_t, std::int64_t>& values() const { return values_; }

  private:
    base::Instant time_;
    std::map<std::uint8_t, std::int64_t> values_;
};

}  // namespace nplc::causes
