#include "seat/seat.h"

#include <atomic>

namespace nplc::faces {

std::optional<Seat::Verdict> Seat::wrong_side(Side side) const {
    if (control_ == Control::local && side != Side::person) return Verdict::local;
    if (control_ == Control::remote && side != Side::plant) return Verdict::remote;
    return std::nullopt;
}

Seat::Verdict Seat::take(const Sitter& client, base::Instant now) {
    look(now);
    if (const auto verdict = wrong_side(client.side)) return *verdict;
    if (holder_ && holder_->number != client.number) return Verdict::taken;
    if (!holder_) holder_ = client;
    since_ = now;
    return Verdict::granted;
}

void Seat::leave(std::uint64_t client) {
    if (holder_ && holder_->number == client) holder_.reset();
}

void Seat::look(base::Instant now) {
    if (holder_ && (now >= since_ + silence_ || wrong_side(holder_->side))) holder_.reset();
}

std::uint64_t Seat::new_number() {
    static std::atomic<std::uint64_t> next{1};
    return next.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace nplc::faces
