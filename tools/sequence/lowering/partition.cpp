#include <algorithm>
#include <bit>

#include "lowering/cover.h"
#include "lowering/least_list.h"
#include "lowering/ternary.h"

namespace nplc::seqc {
namespace {

constexpr int kSearchBound = 500;

bool is_disjoint(const std::vector<Cube>& cubes) {
    Points seen;
    for (Cube cube : cubes) {
        if ((seen & points_of(cube)).any()) return false;
        seen |= points_of(cube);
    }
    return true;
}

/// The smallest decision tree whose leaves are all in or all out of `need`.
class Tree {
  public:
    Tree(const Points& need, std::size_t variables)
        : cubes_(Ternary::of(variables)), nodes_(cubes_.size()), missing_(cubes_.size()) {
        for (std::size_t point = 0; point < std::size_t{1} << variables; ++point)
            missing_[cubes_.point(point)] = need[point] ? 0 : 1;
        cubes_.unite(missing_.data());
        for (std::size_t i = 0; i < cubes_.size(); ++i) solve(i);
    }

    std::vector<Cube> leaves() const {
        std::vector<Cube> cubes;
        collect(cubes_.size() - 1, cubes);
        return cubes;
    }

  private:
    static constexpr std::uint8_t kLeaf = Ternary::kMostVariables;
    struct Node {
        std::uint8_t leaves = 0;
        std::uint8_t split = kLeaf;
    };

    void solve(std::size_t index) {
        Node& node = nodes_[index];
        const Ternary::Entry& cube = cubes_[index];
        if (missing_[index] == 0) {
            node.leaves = 1;
            return;
        }
        if (cube.care + 1U == std::size_t{1} << cubes_.variables()) return;
        node.leaves = 255;
        for (std::size_t v = 0; v < cubes_.variables(); ++v) {
            if ((cube.care >> v) & 1) continue;
            const int leaves =
                nodes_[cubes_.half(index, v, false)].leaves + nodes_[cubes_.half(index, v, true)].leaves;
            if (leaves >= node.leaves) continue;
            node.leaves = static_cast<std::uint8_t>(leaves);
            node.split = static_cast<std::uint8_t>(v);
        }
    }

    void collect(std::size_t index, std::vector<Cube>& cubes) const {
        const Node& node = nodes_[index];
        if (node.leaves == 0) return;
        if (node.split == kLeaf) {
            cubes.push_back({cubes_[index].value, cubes_[index].care});
            return;
        }
        collect(cubes_.half(index, node.split, true), cubes);
        collect(cubes_.half(index, node.split, false), cubes);
    }

    const Ternary& cubes_;
    std::vector<Node> nodes_;
    std::vector<std::uint8_t> missing_;  // by cube: whether one of its points is not needed
};

/// Searches for fewer disjoint cubes than an initial solution, down to a lower bound.
class PartitionSearch {
  public:
    PartitionSearch(std::vector<Cube> first, std::size_t least, std::size_t variables)
        : best_(std::move(first)), least_(least), last_((1U << variables) - 1U) {}

    std::vector<Cube> run(const Points& need) {
        find_strangers(need);
        std::vector<Cube> chosen;
        search(need, chosen);
        return best_;
    }

  private:
    /// Finds an independent set: points of which no two are in one cube inside `need`, so each needs its own
    /// cube.
    void find_strangers(const Points& need) {
        for (unsigned a = 0; a <= last_; ++a) {
            if (!need.test(a)) continue;
            bool is_stranger = true;
            for (unsigned b = 0; b < a && is_stranger; ++b) {
                if (strangers_.test(b)) is_stranger = !lies_in(around(a, b), need);
            }
            if (is_stranger) strangers_.set(a);
        }
    }

    Cube around(unsigned a, unsigned b) const {
        const unsigned care = ~(a ^ b) & last_;
        return {static_cast<std::uint8_t>(a & care), static_cast<std::uint8_t>(care)};
    }

    Points cut(Cube cube) const {
        Points points = points_of(cube);
        return last_ + 1U == kPoints ? points : points & ~(Points().set() << (last_ + 1U));
    }

    bool lies_in(Cube cube, const Points& set) const { return (cut(cube) & ~set).none(); }

    /// All cubes inside `open` that contain the point of `cube`, extended by `variable` and those above it.
    void widen(Cube cube, const Points& points, unsigned variable, const Points& open,
               std::vector<Cube>& cubes) const {
        cubes.push_back(cube);
        for (unsigned v = variable; 1U << v <= last_; ++v) {
            const auto bit = static_cast<std::uint8_t>(1U << v);
            const Points mirrored = (cube.value & bit) != 0 ? points >> bit : points << bit;
            if ((mirrored & ~open).any()) continue;
            const Cube wider{static_cast<std::uint8_t>(cube.value & ~bit),
                             static_cast<std::uint8_t>(cube.care & ~bit)};
            widen(wider, points | mirrored, v + 1, open, cubes);
        }
    }

    /// Largest first.
    std::vector<Cube> cubes_with(unsigned point, const Points& open) const {
        std::vector<Cube> cubes;
        const Cube alone{static_cast<std::uint8_t>(point), static_cast<std::uint8_t>(last_)};
        widen(alone, Points().set(point), 0, open, cubes);
        std::stable_sort(cubes.begin(), cubes.end(),
                         [](Cube a, Cube b) { return std::popcount(a.care) < std::popcount(b.care); });
        return cubes;
    }

    /// The open point with the fewest open neighbours: it is in few cubes.
    unsigned most_constrained(const Points& open) const {
        unsigned best = 0;
        int fewest = 8;
        for (unsigned point = 0; point <= last_; ++point) {
            if (!open.test(point)) continue;
            int neighbours = 0;
            for (unsigned bit = 1; bit <= last_; bit *= 2) neighbours += open.test(point ^ bit) ? 1 : 0;
            if (neighbours >= fewest) continue;
            fewest = neighbours;
            best = point;
        }
        return best;
    }

    void search(const Points& open, std::vector<Cube>& chosen) {
        if (open.none()) {
            if (chosen.size() < best_.size()) best_ = chosen;
            return;
        }
        if (best_.size() <= least_ || ++steps_ > kSearchBound) return;
        const std::size_t further = std::max<std::size_t>((open & strangers_).count(), 1);
        if (chosen.size() + further >= best_.size()) return;
        for (Cube cube : cubes_with(most_constrained(open), open)) {
            chosen.push_back(cube);
            search(open & ~cut(cube), chosen);
            chosen.pop_back();
        }
    }

    std::vector<Cube> best_;
    std::size_t least_;
    unsigned last_;
    Points strangers_;
    int steps_ = 0;
};

/// The minimum over few variables; `least` is a lower bound.
void shorten_small(std::vector<Cube>& cubes, const Points& need, std::size_t least, std::size_t variables) {
    if (cubes.size() == least) return;
    const auto set = static_cast<SmallSet>((need & Points(0xFFFFFFFFU)).to_ulong());
    const auto fewer = least_partition(set, SmallCubes::of(variables, 0), cubes.size());
    if (fewer.empty()) return;
    cubes.clear();
    for (const SmallCubes::Entry* cube : fewer) cubes.push_back({cube->value, cube->care});
}

}  // namespace

std::vector<Cube> disjoint_cover(const Points& need) {
    if (need.none()) return {};
    std::vector<Cube> overlapping = minimal_cover(need, need);
    if (is_disjoint(overlapping)) return overlapping;
    const Variables variables({&need});
    const Points narrow = variables.narrowed(need);
    std::vector<Cube> cubes = Tree(narrow, variables.count()).leaves();
    if (variables.count() <= SmallCubes::kMostVariables) {
        shorten_small(cubes, narrow, overlapping.size(), variables.count());
    } else if (cubes.size() > overlapping.size()) {
        cubes = PartitionSearch(std::move(cubes), overlapping.size(), variables.count()).run(narrow);
    }
    for (Cube& cube : cubes) cube = variables.widened(cube);
    return cubes;
}

}  // namespace nplc::seqc
