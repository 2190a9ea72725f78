#include "lowering/cover.h"

#include <algorithm>
#include <array>
#include <bit>
#include <bitset>
#include <cstddef>
#include <utility>
#include <vector>

#include "lowering/ternary.h"

namespace nplc::seqc {
namespace {

/// Minimum set cover of `need`: exact up to a search limit, beyond it greedy. Ties are resolved in favour of
/// earlier sets.
template <std::size_t kSize>
class CoverSearch {
  public:
    using Set = std::bitset<kSize>;

    /// `useful`: the intersection of each set with `need`; their union is `need`.
    CoverSearch(const Set& need, std::vector<Set> useful) : need_(need), useful_(std::move(useful)) {
        for (std::size_t point = 0; point < kSize; ++point) {
            if (!need.test(point)) continue;
            for (std::size_t i = 0; i < useful_.size(); ++i) {
                if (useful_[i].test(point)) choices_[point].push_back(i);
            }
        }
    }

    /// Indices of the chosen sets.
    std::vector<std::size_t> run() {
        best_ = greedy();
        std::vector<std::size_t> chosen;
        search(need_, chosen);
        return best_;
    }

  private:
    static constexpr int kSearchBound = 2'000;

    /// The set that covers most open points, and their number.
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

    /// The open point covered by the fewest sets.
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

/// The prime implicants: the cubes inside `allowed` that contain some of `need` and are in no larger one.
/// Both are sets over the variables of `cubes`. The marks are by the cubes' index.
template <std::size_t kSize>
std::vector<std::uint8_t> mark_primes(const std::bitset<kSize>& need, const std::bitset<kSize>& allowed,
                                      const Ternary& cubes) {
    enum Mark : std::uint8_t { kOutside = 1, kNeeded = 2 };
    std::vector<std::uint8_t> marks(cubes.size());
    for (std::size_t point = 0; point < std::size_t{1} << cubes.variables(); ++point) {
        marks[cubes.point(point)] =
            static_cast<std::uint8_t>((allowed[point] ? 0 : kOutside) | (need[point] ? kNeeded : 0));
    }
    cubes.unite(marks.data());
    std::vector<std::uint8_t> is_inside(cubes.size());
    std::vector<std::uint8_t> is_prime(cubes.size());
    for (std::size_t i = 0; i < cubes.size(); ++i) {
        is_inside[i] = (marks[i] & kOutside) == 0 ? 1 : 0;
        is_prime[i] = marks[i] == kNeeded ? 1 : 0;
    }
    cubes.remove_wider(is_inside.data(), is_prime.data());
    return is_prime;
}

}  // namespace

std::vector<Cube> minimal_cover(const Points& need, const Points& allowed) {
    if (need.none()) return {};
    const Variables<kPoints> variables({&need, &allowed});
    const Ternary& cubes = Ternary::of(variables.count());
    const Points narrow = variables.narrowed(need);
    const std::vector<std::uint8_t> is_prime = mark_primes(narrow, variables.narrowed(allowed), cubes);
    std::vector<Product> primes;
    std::vector<Points> useful;
    for (const std::size_t index : cubes.largest_first()) {
        if (is_prime[index] == 0) continue;
        const Points covered = points_of(cube_of(cubes[index])) & narrow;
        const bool dominated = std::any_of(useful.begin(), useful.end(),
                                           [&](const Points& wider) { return (covered & ~wider).none(); });
        if (dominated) continue;
        primes.push_back(cubes[index]);
        useful.push_back(covered);
    }
    std::vector<Cube> chosen;
    for (std::size_t i : CoverSearch<kPoints>(narrow, std::move(useful)).run())
        chosen.push_back(cube_of(variables.widened(primes[i])));
    return chosen;
}

namespace {

/// By the first differing bit: required 1, required 0, don't care.
bool comes_before(const Product& a, const Product& b) {
    for (std::size_t bit = 0; bit < kBits; ++bit) {
        const auto rank = [bit](const Product& p) { return !p.cares(bit) ? 2 : p.wants(bit) ? 0 : 1; };
        if (rank(a) != rank(b)) return rank(a) < rank(b);
    }
    return false;
}

}  // namespace

std::vector<Product> shortest_products(const Truth& need, const Truth& allowed) {
    if (need.none()) return {};
    const Variables<kCases> variables({&need, &allowed});
    const Ternary& cubes = Ternary::of(variables.count());
    const std::vector<std::uint8_t> is_prime =
        mark_primes(variables.narrowed(need), variables.narrowed(allowed), cubes);
    std::vector<Product> primes;
    for (std::size_t i = 0; i < cubes.size(); ++i) {
        if (is_prime[i] != 0) primes.push_back(variables.widened(cubes[i]));
    }
    std::stable_sort(primes.begin(), primes.end(), [](const Product& a, const Product& b) {
        return std::popcount(a.care) < std::popcount(b.care);
    });
    std::vector<Truth> useful;
    for (const Product& prime : primes) useful.push_back(truth_of(prime) & need);
    std::vector<std::size_t> chosen = CoverSearch<kCases>(need, std::move(useful)).run();
    std::vector<Product> cover;
    for (std::size_t i : chosen) cover.push_back(primes[i]);
    std::sort(cover.begin(), cover.end(), comes_before);
    return cover;
}

}  // namespace nplc::seqc
