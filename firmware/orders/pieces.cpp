#include "orders/pieces.h"

#include <algorithm>

namespace nplc::orders {

std::span<const std::uint8_t> piece_of(std::span<const std::uint8_t> whole, std::size_t number) {
    const std::size_t begin = std::min(number * kPieceBytes, whole.size());
    return whole.subspan(begin, std::min(kPieceBytes, whole.size() - begin));
}

std::size_t Pieces::missing() const {
    return static_cast<std::size_t>(
        std::count_if(pieces_.begin(), pieces_.end(), [](const auto& piece) { return piece.empty(); }));
}

Pieces::Verdict Pieces::take(std::size_t number, std::span<const std::uint8_t> piece) {
    if (number >= pieces_.size()) return Verdict::not_one;
    const bool is_last = number + 1 == pieces_.size();
    if (piece.size() != (is_last ? bytes_ - number * kPieceBytes : kPieceBytes)) return Verdict::not_one;
    if (!artifact_.empty()) return Verdict::whole;
    pieces_[number].assign(piece.begin(), piece.end());
    if (missing() != 0) return Verdict::taken;
    std::vector<std::uint8_t> all;
    for (const auto& one : pieces_) all.insert(all.end(), one.begin(), one.end());
    if (sha256(all) == hash_) {
        artifact_ = std::move(all);
        return Verdict::whole;
    }
    for (auto& one : pieces_) one.clear();
    return Verdict::wrong_whole;
}

}  // namespace nplc::orders
