#include "gateway/debouncer.h"

#include <algorithm>

namespace nplc::gateway {

std::uint8_t Debouncer::update(std::uint8_t raw, base::Instant now) {
    if (first_) {
        first_ = false;
        levels_ = raw & 0x3F;
        return levels_;
    }
    const auto differing = static_cast<std::uint8_t>((raw ^ levels_) & 0x3F);
    changing_ &= differing;
    for (unsigned i = 0; differing >> i != 0; ++i) {
        const auto bit = static_cast<std::uint8_t>(differing & (1U << i));
        if (bit == 0) continue;
        if ((changing_ & bit) == 0) since_[i] = now;
        changing_ |= bit;
        if (now - since_[i] < steady_) continue;
        levels_ ^= bit;
        changing_ ^= bit;
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
