#include "lowering/cover.h"

#include <algorithm>
#include <array>
#include <bit>
#include <bitset>
#include <cstddef>
#include <tuple>
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

struct Prime {
    Cube cube;
    Points useful;  // the needed points that it covers
};

/// Useful implicants inside `allowed`, largest first: none covers a subset of the part of `need` that an
/// earlier one covers.
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

}  // namespace

std::vector<Cube> minimal_cover(const Points& need, const Points& allowed) {
    if (need.none()) return {};
    const Variables variables({&need, &allowed});
    const Points narrow = variables.narrowed(need);
    const std::vector<Prime> primes = primes_of(narrow, variables.narrowed(allowed), variables.count());
    std::vector<Points> useful;
    for (const Prime& prime : primes) useful.push_back(prime.useful);
    std::vector<Cube> cubes;
    for (std::size_t i : CoverSearch<kPoints>(narrow, std::move(useful)).run())
        cubes.push_back(variables.widened(primes[i].cube));
    return cubes;
}

namespace {

/// All products over some of the ten bits, as ternary numbers with one digit per bit: 0 and 1 require that
/// value, 2 is don't care. A product is the union of the two with one digit 2 replaced by 0 and by 1.
class Products {
  public:
    Products(const Truth& need, const Truth& allowed) {
        for (std::size_t bit = 0; bit < kBits; ++bit) {
            if (depends_on(need, bit) || depends_on(allowed, bit)) bits_.push_back(bit);
        }
        for (std::size_t i = 0; i <= bits_.size(); ++i) powers_.push_back(i == 0 ? 1 : powers_.back() * 3);
        marks_.resize(powers_.back());
        for (std::size_t number = 0; number < marks_.size(); ++number) mark(number, need, allowed);
    }

    /// Prime implicants: products inside `allowed` that intersect `need` and are not contained in another
    /// one, short ones first.
    std::vector<Product> primes() const {
        std::vector<Product> found;
        for (std::size_t number = 0; number < marks_.size(); ++number) {
            if (marks_[number] == (kInside | kUseful) && !is_within_another(number))
                found.push_back(product(number));
        }
        std::stable_sort(found.begin(), found.end(), [](const Product& a, const Product& b) {
            return std::popcount(a.care) < std::popcount(b.care);
        });
        return found;
    }

  private:
    static constexpr std::uint8_t kInside = 1;  // contained in `allowed`
    static constexpr std::uint8_t kUseful = 2;  // intersects `need`

    std::size_t digit(std::size_t number, std::size_t place) const { return number / powers_[place] % 3; }

    void mark(std::size_t number, const Truth& need, const Truth& allowed) {
        for (std::size_t place = 0; place < bits_.size(); ++place) {
            if (digit(number, place) != 2) continue;
            const std::uint8_t one = marks_[number - powers_[place]];
            const std::uint8_t zero = marks_[number - 2 * powers_[place]];
            marks_[number] = static_cast<std::uint8_t>((one & zero & kInside) | ((one | zero) & kUseful));
            return;
        }
        const std::size_t c = product(number).value;
        marks_[number] =
            static_cast<std::uint8_t>((allowed.test(c) ? kInside : 0) | (need.test(c) ? kUseful : 0));
    }

    bool is_within_another(std::size_t number) const {
        for (std::size_t place = 0; place < bits_.size(); ++place) {
            const std::size_t wider = number + (2 - digit(number, place)) * powers_[place];
            if (wider != number && (marks_[wider] & kInside) != 0) return true;
        }
        return false;
    }

    Product product(std::size_t number) const {
        Product result;
        for (std::size_t place = 0; place < bits_.size(); ++place) {
            const auto bit = static_cast<std::uint16_t>(1U << bits_[place]);
            if (digit(number, place) != 2) result.care |= bit;
            if (digit(number, place) == 1) result.value |= bit;
        }
        return result;
    }

    std::vector<std::size_t> bits_;
    std::vector<std::size_t> powers_;
    std::vector<std::uint8_t> marks_;
};

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
    const std::vector<Product> primes = Products(need, allowed).primes();
    std::vector<Truth> useful;
    for (const Product& prime : primes) useful.push_back(truth_of(prime) & need);
    std::vector<std::size_t> chosen = CoverSearch<kCases>(need, std::move(useful)).run();
    std::vector<Product> cover;
    for (std::size_t i : chosen) cover.push_back(primes[i]);
    std::sort(cover.begin(), cover.end(), comes_before);
    return cover;
}

}  // namespace nplc::seqc
