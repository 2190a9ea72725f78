#include "gateway/debouncer.h"

#include <algorithm>

namespace nplc::gateway {

std::uint8_t Debouncer::update(std::uint8_t raw, base::Instant now) {
    if (first_) {
        first_ = false;
        levels_ = raw & 0x3F;
        return levels_;
    }
    for (unsigned i = 0; i < since_.size(); ++i) {
        const auto bit = static_cast<std::uint8_t>(1U << i);
        if (((raw ^ levels_) & bit) == 0) {
            changing_ &= static_cast<std::uint8_t>(~bit);
            continue;
        }
        if ((changing_ & bit) == 0) {
            changing_ |= bit;
            since_[i] = now;
        }
        if (now - since_[i] < steady_) continue;
        levels_ ^= bit;
        changing_ &= static_cast<std::uint8_t>(~bit);
    }
    return levels_;
}

base::Instant Debouncer::next_update() const {
    base::Instant next = base::kNever;
    for (unsigned i = 0; i < since_.size(); ++i) {
        if ((changing_ >> i & 1U) != 0) next = std::min(next, since_[i] + steady_);
    }
    return next;
}

}  // namespace nplc::gateway
