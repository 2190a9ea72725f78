#include "terms/cover.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "terms/cover_search.h"

namespace nplc::seqc {
namespace {

constexpr std::size_t kVariables = 7;

std::vector<Points> make_cubes() {
    std::vector<Points> cubes(kPoints * kPoints);
    for (std::size_t care = 0; care < kPoints; ++care) {
        for (std::size_t value = 0; value < kPoints; ++value) {
            if ((value & ~care) != 0) continue;
            for (std::size_t point = 0; point < kPoints; ++point) {
                if ((point & care) == value) cubes[care * kPoints + value].set(point);
            }
        }
    }
    return cubes;
}

/// All cubes, wide ones first.
std::vector<Cube> make_order() {
    std::vector<Cube> order;
    for (int literals = 0; literals <= static_cast<int>(kVariables); ++literals) {
        for (unsigned care = 0; care < kPoints; ++care) {
            if (std::popcount(care) != literals) continue;
            for (unsigned value = 0; value < kPoints; ++value) {
                if ((value & ~care) == 0) {
                    order.push_back({static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(care)});
                }
            }
        }
    }
    return order;
}

const std::vector<Cube>& cubes_in_order() {
    static const std::vector<Cube> order = make_order();
    return order;
}

bool contains(const Points& outer, const Points& inner) {
    return (inner & ~outer).none();
}

/// Cubes inside `allowed` that are worth taking: none holds a smaller part of `need` than another.
std::vector<Cube> primes_of(const Points& need, const Points& allowed) {
    std::vector<Cube> primes;
    for (Cube cube : cubes_in_order()) {
        const Points useful = points_of(cube) & need;
        if (useful.none() || !contains(allowed, points_of(cube))) continue;
        const bool dominated = std::any_of(primes.begin(), primes.end(),
                                           [&](Cube wider) { return contains(points_of(wider), useful); });
        if (!dominated) primes.push_back(cube);
    }
    return primes;
}

bool is_disjoint(const std::vector<Cube>& cubes) {
    Points seen;
    for (Cube cube : cubes) {
        if ((seen & points_of(cube)).any()) return false;
        seen |= points_of(cube);
    }
    return true;
}

/// The smallest tree of questions whose leaves are all in or all out of `need`.
class Partition {
  public:
    explicit Partition(const Points& need) : need_(need) {}

    std::vector<Cube> run() {
        const std::vector<Cube>& order = cubes_in_order();
        for (auto cube = order.rbegin(); cube != order.rend(); ++cube) solve(*cube);
        std::vector<Cube> leaves;
        collect({0, 0}, leaves);
        return leaves;
    }

  private:
    static constexpr std::uint8_t kLeaf = kVariables;
    struct Node {
        std::uint8_t leaves = 0;
        std::uint8_t split = kLeaf;
    };

    static std::size_t index(Cube cube) { return cube.care * kPoints + cube.value; }
    static Cube with(Cube cube, std::size_t variable, bool value) {
        const auto bit = static_cast<std::uint8_t>(1U << variable);
        return {static_cast<std::uint8_t>(cube.value | (value ? bit : 0)),
                static_cast<std::uint8_t>(cube.care | bit)};
    }

    void solve(Cube cube) {
        Node& node = nodes_[index(cube)];
        const Points inside = points_of(cube) & need_;
        if (inside.none()) return;
        if (inside == points_of(cube)) {
            node.leaves = 1;
            return;
        }
        node.leaves = 255;
        for (std::size_t variable = 0; variable < kVariables; ++variable) {
            if ((cube.care >> variable) & 1) continue;
            const int leaves = nodes_[index(with(cube, variable, false))].leaves +
                               nodes_[index(with(cube, variable, true))].leaves;
            if (leaves < node.leaves) {
                node = {static_cast<std::uint8_t>(leaves), static_cast<std::uint8_t>(variable)};
            }
        }
    }

    void collect(Cube cube, std::vector<Cube>& leaves) const {
        const Node& node = nodes_[index(cube)];
        if (node.leaves == 0) return;
        if (node.split == kLeaf) {
            leaves.push_back(cube);
            return;
        }
        collect(with(cube, node.split, true), leaves);
        collect(with(cube, node.split, false), leaves);
    }

    Points need_;
    std::vector<Node> nodes_ = std::vector<Node>(kPoints * kPoints);
};

}  // namespace

const Points& points_of(Cube cube) {
    static const std::vector<Points> cubes = make_cubes();
    return cubes[cube.care * kPoints + cube.value];
}

std::vector<Cube> minimal_cover(const Points& need, const Points& allowed) {
    if (need.none()) return {};
    const std::vector<Cube> primes = primes_of(need, allowed);
    std::vector<Points> useful;
    for (Cube prime : primes) useful.push_back(points_of(prime) & need);
    std::vector<Cube> cover;
    for (std::size_t i : CoverSearch<kPoints>(need, std::move(useful)).run()) cover.push_back(primes[i]);
    return cover;
}

std::vector<Cube> disjoint_cover(const Points& need) {
    if (need.none()) return {};
    std::vector<Cube> overlapping = minimal_cover(need, need);
    if (is_disjoint(overlapping)) return overlapping;
    return Partition(need).run();
}

}  // namespace nplc::seqc
