#include "terms/cover.h"

#include <algorithm>
#include <array>
#include <bit>
#include <tuple>
#include <utility>

#include "terms/ternary.h"
#include "terms/variables.h"

namespace nplc::seqc {
namespace {

constexpr int kSearchBound = 2'000;

struct Prime {
    Cube cube;
    Points useful;  // the points that it takes of those needed
};

/// Cubes inside `allowed` that are worth taking, wide ones first: none holds a smaller part of `need` than
/// one before it.
std::vector<Prime> primes_of(const Points& need, const Points& allowed, std::size_t variables) {
    enum Mark : std::uint8_t { kOutside = 1, kNeeded = 2 };
    const Ternary& cubes = Ternary::of(variables);
    std::array<std::uint8_t, Ternary::kMostCubes> marks;
    std::array<std::uint8_t, Ternary::kMostCubes> is_inside;
    std::array<std::uint8_t, Ternary::kMostCubes> is_prime;
    std::vector<Cube> found;
    for (std::size_t point = 0; point < std::size_t{1} << variables; ++point) {
        marks[cubes.point(point)] =
            static_cast<std::uint8_t>((allowed[point] ? 0 : kOutside) | (need[point] ? kNeeded : 0));
    }
    cubes.unite(marks.data());
    for (std::size_t i = 0; i < cubes.size(); ++i) {
        is_inside[i] = (marks[i] & kOutside) == 0 ? 1 : 0;
        is_prime[i] = marks[i] == kNeeded ? 1 : 0;
    }
    cubes.remove_wider(is_inside.data(), is_prime.data());
    for (std::size_t i = 0; i < cubes.size(); ++i) {
        if (is_prime[i] != 0) found.push_back({cubes[i].value, cubes[i].care});
    }
    const auto rank = [](Cube c) { return std::tuple(std::popcount(c.care), c.care, c.value); };
    std::sort(found.begin(), found.end(), [&](Cube a, Cube b) { return rank(a) < rank(b); });
    std::vector<Prime> primes;
    for (Cube cube : found) {
        const Prime prime{cube, points_of(cube) & need};
        const bool dominated = std::any_of(primes.begin(), primes.end(), [&](const Prime& wider) {
            return (prime.useful & ~wider.useful).none();
        });
        if (!dominated) primes.push_back(prime);
    }
    return primes;
}

class CoverSearch {
  public:
    CoverSearch(const Points& need, std::vector<Prime> primes) : need_(need), primes_(std::move(primes)) {
        for (std::size_t point = 0; point < kPoints; ++point) {
            if (!need.test(point)) continue;
            for (std::size_t i = 0; i < primes_.size(); ++i) {
                if (primes_[i].useful.test(point)) choices_[point].push_back(i);
            }
        }
    }

    std::vector<Cube> run() {
        best_ = greedy();
        std::vector<std::size_t> chosen;
        search(need_, chosen);
        std::vector<Cube> cubes;
        for (std::size_t i : best_) cubes.push_back(primes_[i].cube);
        return cubes;
    }

  private:
    /// The prime that holds most open points, and how many.
    std::pair<std::size_t, std::size_t> widest(const Points& open) const {
        std::pair<std::size_t, std::size_t> best = {0, 0};
        for (std::size_t i = 0; i < primes_.size(); ++i) {
            const std::size_t count = (primes_[i].useful & open).count();
            if (count > best.second) best = {i, count};
        }
        return best;
    }

    std::vector<std::size_t> greedy() const {
        std::vector<std::size_t> chosen;
        for (Points open = need_; open.any(); open &= ~primes_[chosen.back()].useful)
            chosen.push_back(widest(open).first);
        return chosen;
    }

    /// The open point with the fewest primes to choose from.
    std::size_t hardest_point(const Points& open) const {
        std::size_t hardest = kPoints;
        for (std::size_t point = 0; point < kPoints; ++point) {
            if (!open.test(point)) continue;
            if (hardest == kPoints || choices_[point].size() < choices_[hardest].size()) hardest = point;
        }
        return hardest;
    }

    void search(const Points& open, std::vector<std::size_t>& chosen) {
        if (open.none()) {
            if (chosen.size() < best_.size()) best_ = chosen;
            return;
        }
        if (++steps_ > kSearchBound) return;
        const std::size_t most = widest(open).second;
        if (chosen.size() + (open.count() + most - 1) / most >= best_.size()) return;
        for (std::size_t choice : choices_[hardest_point(open)]) {
            chosen.push_back(choice);
            search(open & ~primes_[choice].useful, chosen);
            chosen.pop_back();
        }
    }

    Points need_;
    std::vector<Prime> primes_;
    std::array<std::vector<std::size_t>, kPoints> choices_;
    std::vector<std::size_t> best_;
    int steps_ = 0;
};

}  // namespace

std::vector<Cube> minimal_cover(const Points& need, const Points& allowed) {
    if (need.none()) return {};
    const Variables variables({&need, &allowed});
    const Points narrow = variables.narrowed(need);
    std::vector<Cube> cubes =
        CoverSearch(narrow, primes_of(narrow, variables.narrowed(allowed), variables.count())).run();
    for (Cube& cube : cubes) cube = variables.widened(cube);
    return cubes;
}

}  // namespace nplc::seqc
