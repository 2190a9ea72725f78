#include "seat/seat.h"

#include <algorithm>
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
    if (holder_ && !is_holder(client)) return was_taken_from(client) ? Verdict::taken_over : Verdict::taken;
    sit(client, now);
    return Verdict::granted;
}

Seat::Verdict Seat::take_over(const Sitter& client, base::Instant now) {
    const Verdict verdict = take(client, now);
    if (verdict != Verdict::taken && verdict != Verdict::taken_over) return verdict;
    news_ = TakeOver{*holder_, client};
    taken_from_ = std::exchange(holder_, std::nullopt);
    sit(client, now);
    return Verdict::granted;
}

void Seat::sit(const Sitter& client, base::Instant now) {
    if (!holder_) {
        holder_ = client;
        sitting_.clear();
    }
    if (std::find(sitting_.begin(), sitting_.end(), client.number) == sitting_.end())
        sitting_.push_back(client.number);
    since_ = now;
}

void Seat::leave(std::uint64_t client) {
    std::erase(sitting_, client);
    if (holder_ && sitting_.empty()) free();
}

bool Seat::give_back(const Sitter& client) {
    if (!is_holder(client)) return false;
    free();
    return true;
}

void Seat::free() {
    holder_.reset();
    taken_from_.reset();
    sitting_.clear();
}

void Seat::look(base::Instant now) {
    if (holder_ && (now >= since_ + silence_ || wrong_side(holder_->side))) free();
}

bool Seat::is_same(const Sitter& a, const Sitter& b) {
    return a.number == b.number || (!a.user.empty() && a.user == b.user && a.side == b.side);
}

std::uint64_t Seat::new_number() {
    static std::atomic<std::uint64_t> next{1};
    return next.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace nplc::faces
