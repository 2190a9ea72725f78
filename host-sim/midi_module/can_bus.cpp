#include "sim/can_bus.h"

#include <algorithm>
#include <set>

namespace nplc::sim {
namespace {

/// Start, identifier, control, check sum, acknowledgement, end and the pause after it.
constexpr std::int64_t kBitsAround = 47;

}  // namespace

void CanBus::send(const Frame& frame, int sender) {
    waiting_.push_back({frame, sender});
}

void CanBus::start(Time now) {
    if (under_way_ || waiting_.empty()) return;
    auto best = waiting_.end();
    std::set<int> seen;
    for (auto at = waiting_.begin(); at != waiting_.end(); ++at) {
        if (!seen.insert(at->sender).second) continue;
        if (best == waiting_.end() || at->frame.id < best->frame.id) best = at;
    }
    under_way_ = *best;
    waiting_.erase(best);
    const std::int64_t bits = kBitsAround + 8 * std::int64_t{under_way_->frame.size};
    ends_ = std::max(ends_, now) + Time{bits * 1'000'000'000 / bit_rate_};
}

std::optional<CanBus::Heard> CanBus::take(Time now) {
    start(now);
    if (!under_way_ || ends_ > now) return std::nullopt;
    const auto heard = under_way_;
    under_way_.reset();
    start(now);
    return heard;
}

std::optional<Time> CanBus::next_event() const {
    if (!under_way_) return std::nullopt;
    return ends_;
}

}  // namespace nplc::sim
