#include <algorithm>
#include <array>

#include "lowering/cover.h"
#include "lowering/failures.h"
#include "lowering/ternary.h"

namespace nplc::seqc {
namespace {

constexpr std::size_t kMostNodes = 1'000;  // over more variables than `kMostSmall`

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
        const Product& cube = cubes_[index];
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
            cubes.push_back(cube_of(cubes_[index]));
            return;
        }
        collect(cubes_.half(index, node.split, true), cubes);
        collect(cubes_.half(index, node.split, false), cubes);
    }

    const Ternary& cubes_;
    std::vector<Node> nodes_;
    std::vector<std::uint8_t> missing_;  // by cube: whether one of its points is not needed
};

/// Searches for fewer disjoint cubes than a solution has, down to a lower bound.
class PartitionSearch {
  public:
    PartitionSearch(const Points& need, const Ternary& cubes)
        : need_(need), cubes_(cubes), sets_(cubes.size()), points_(cubes.size()) {
        for (std::size_t point = 0; point < std::size_t{1} << cubes.variables(); ++point)
            sets_[cubes.point(point)].set(point);
        cubes.unite(sets_.data());
        for (const std::uint16_t index : cubes.largest_first()) {
            if ((sets_[index] & ~need).any()) continue;
            inside_.push_back(index);
            for (std::size_t point = 0; point < kPoints; ++point) {
                if (sets_[index].test(point)) points_[index].push_back(static_cast<std::uint8_t>(point));
            }
        }
        find_independent();
    }

    void shorten(std::vector<Cube>& best, std::size_t least) {
        while (best.size() > least && search(need_, inside_, best.size() - 1)) {
            best.clear();
            for (const std::size_t index : path_) best.push_back(cube_of(cubes_[index]));
            path_.clear();
            nodes_ = 0;
        }
    }

  private:
    using Indices = std::vector<std::uint16_t>;

    /// Points of which no two are in one cube inside `need`: each needs its own cube.
    void find_independent() {
        for (std::size_t a = 0; a < kPoints; ++a) {
            if (!need_.test(a)) continue;
            const bool shares = std::any_of(inside_.begin(), inside_.end(), [&](std::size_t index) {
                return sets_[index].test(a) && (sets_[index] & independent_).any();
            });
            if (!shares) independent_.set(a);
        }
    }

    /// The open point in the fewest of `cubes`.
    std::size_t most_constrained(const Points& open, const Indices& cubes) const {
        std::array<std::uint16_t, kPoints> held{};
        for (const std::size_t index : cubes) {
            for (const std::uint8_t point : points_[index]) ++held[point];
        }
        std::size_t best = kPoints;
        for (std::size_t point = 0; point < kPoints; ++point) {
            if (open.test(point) && (best == kPoints || held[point] < held[best])) best = point;
        }
        return best;
    }

    bool is_exhausted() const { return cubes_.variables() > Ternary::kMostSmall && nodes_ > kMostNodes; }

    /// `cubes`: those inside `open`.
    bool search(const Points& open, const Indices& cubes, std::size_t most) {
        if (open.none()) return true;
        if (most < std::max<std::size_t>((open & independent_).count(), 1)) return false;
        if (failures_.has(open, most) || is_exhausted()) return false;
        ++nodes_;
        const std::size_t point = most_constrained(open, cubes);
        for (const std::size_t index : cubes) {
            if (!sets_[index].test(point)) continue;
            Indices left;
            for (const std::uint16_t other : cubes) {
                if ((sets_[other] & sets_[index]).none()) left.push_back(other);
            }
            path_.push_back(index);
            if (search(open & ~sets_[index], left, most - 1)) return true;
            path_.pop_back();
        }
        if (!is_exhausted()) failures_.add(open, most);
        return false;
    }

    Points need_;
    const Ternary& cubes_;
    std::vector<Points> sets_;                       // by cube
    std::vector<std::vector<std::uint8_t>> points_;  // by cube inside `need`
    Indices inside_;
    Points independent_;
    Failures<Points> failures_;
    std::vector<std::size_t> path_;
    std::size_t nodes_ = 0;
};

}  // namespace

std::vector<Cube> disjoint_cover(const Points& need) {
    if (need.none()) return {};
    std::vector<Cube> overlapping = minimal_cover(need, need);
    if (is_disjoint(overlapping)) return overlapping;
    const Variables<kPoints> variables({&need});
    const Points narrow = variables.narrowed(need);
    std::vector<Cube> parts = Tree(narrow, variables.count()).leaves();
    if (parts.size() > overlapping.size())
        PartitionSearch(narrow, Ternary::of(variables.count())).shorten(parts, overlapping.size());
    for (Cube& part : parts) part = cube_of(variables.widened({part.value, part.care}));
    return parts;
}

}  // namespace nplc::seqc
