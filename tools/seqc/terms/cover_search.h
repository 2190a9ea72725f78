#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <utility>
#include <vector>

namespace nplc::seqc {

/// Fewest sets that together hold all of `need`: exact up to a bound on the search, beyond it as few as a
/// greedy choice finds. Of equal choices the earlier sets are taken.
template <std::size_t kSize>
class CoverSearch {
  public:
    using Set = std::bitset<kSize>;

    /// `useful`: what each set holds of `need`; together all of it.
    CoverSearch(const Set& need, std::vector<Set> useful) : need_(need), useful_(std::move(useful)) {
        for (std::size_t point = 0; point < kSize; ++point) {
            if (!need.test(point)) continue;
            for (std::size_t i = 0; i < useful_.size(); ++i) {
                if (useful_[i].test(point)) choices_[point].push_back(i);
            }
        }
    }

    /// Indices of the sets chosen.
    std::vector<std::size_t> run() {
        best_ = greedy();
        std::vector<std::size_t> chosen;
        search(need_, chosen);
        return best_;
    }

  private:
    static constexpr int kSearchBound = 2'000;

    /// The set that holds most open points, and how many.
    std::pair<std::size_t, std::size_t> widest(const Set& open) const {
        std::pair<std::size_t, std::size_t> best = {0, 0};
        for (std::size_t i = 0; i < useful_.size(); ++i) {
            const std::size_t count = (useful_[i] & open).count();
            if (count > best.second) best = {i, count};
        }
        return best;
    }

    std::vector<std::size_t> greedy() const {
        std::vector<std::size_t> chosen;
        for (Set open = need_; open.any(); open &= ~useful_[chosen.back()])
            chosen.push_back(widest(open).first);
        return chosen;
    }

    /// The open point with the fewest sets to choose from.
    std::size_t hardest_point(const Set& open) const {
        std::size_t hardest = kSize;
        for (std::size_t point = 0; point < kSize; ++point) {
            if (!open.test(point)) continue;
            if (hardest == kSize || choices_[point].size() < choices_[hardest].size()) hardest = point;
        }
        return hardest;
    }

    void search(const Set& open, std::vector<std::size_t>& chosen) {
        if (open.none()) {
            if (chosen.size() < best_.size()) best_ = chosen;
            return;
        }
        if (++steps_ > kSearchBound) return;
        const std::size_t most = widest(open).second;
        if (chosen.size() + (open.count() + most - 1) / most >= best_.size()) return;
        for (std::size_t choice : choices_[hardest_point(open)]) {
            chosen.push_back(choice);
            search(open & ~useful_[choice], chosen);
            chosen.pop_back();
        }
    }

    Set need_;
    std::vector<Set> useful_;
    std::array<std::vector<std::size_t>, kSize> choices_;
    std::vector<std::size_t> best_;
    int steps_ = 0;
};

}  // namespace nplc::seqc
