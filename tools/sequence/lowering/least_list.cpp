#include "lowering/least_list.h"

#include <algorithm>
#include <array>
#include <bit>

#include "lowering/failures.h"

namespace nplc::seqc {
namespace {

constexpr std::size_t kMostCubes = 243;
constexpr std::size_t kMostNodes = 20'000;

/// From the last cube of the list to the first: a cube may be next if its open cases are all in or all out.
/// Placing one never removes options. So if a cube did not lead to a list, no list continues from there with
/// it, nor with one that decides a subset of its cases.
class ListSearch {
  public:
    ListSearch(SmallSet set, const Ternary& cubes) : set_(set), cubes_(cubes) {}

    bool run(std::size_t most) {
        path_.clear();
        failed_.clear();
        nodes_ = 0;
        return search(cubes_.cases(cubes_.size() - 1), most);
    }
    std::vector<ListedCube> list() const {
        std::vector<ListedCube> result = path_;
        std::reverse(result.begin(), result.end());
        return result;
    }

  private:
    struct Move {
        SmallSet decides = 0;
        std::size_t cube = 0;
    };
    struct Moves {
        std::array<Move, kMostCubes> list;
        std::size_t count = 0;
    };

    bool keep(std::size_t cube, bool in) {
        path_.push_back({cubes_[cube], in});
        return true;
    }

    bool search(SmallSet open, std::size_t most) {
        const SmallSet in = open & set_;
        const SmallSet out = open & ~set_;
        if (in == 0) return true;
        if (most == 0) return false;
        const std::size_t whole = cubes_.around(in);
        const SmallSet wrong = cubes_.cases(whole) & out;
        if (wrong == 0) return keep(whole, true);
        if (most == 1) return false;
        if (most == 2) return finish_with_two(in, out, whole, wrong);
        if (failures_.has(open, most) || ++nodes_ > kMostNodes) return false;
        Moves moves;
        list_moves(open, moves);
        const std::size_t failed_before = failed_.size();
        for (std::size_t i = 0; i < moves.count; ++i) {
            const Move& move = moves.list[i];
            if (has_failed(move.decides)) continue;
            const std::size_t length = path_.size();
            keep(move.cube, (move.decides & set_) != 0);
            if (search(open & ~move.decides, most - 1)) return true;
            path_.resize(length);
            failed_.push_back(move.decides);
        }
        failed_.resize(failed_before);
        if (nodes_ <= kMostNodes) failures_.add(open, most);
        return false;
    }

    /// An "out" cube behind the cube around all "in" cases, or two "in" cubes.
    bool finish_with_two(SmallSet in, SmallSet out, std::size_t whole, SmallSet wrong) {
        const std::size_t around_wrong = cubes_.around(wrong);
        if ((cubes_.cases(around_wrong) & in) == 0) return keep(around_wrong, false) && keep(whole, true);
        const SmallSet first = in & -in;
        for (const std::size_t i : cubes_.largest_first()) {
            const SmallSet cases = cubes_.cases(i);
            if ((cases & first) == 0 || (cases & out) != 0) continue;
            const std::size_t rest = cubes_.around(in & ~cases);
            if ((cubes_.cases(rest) & out) == 0) return keep(i, true) && keep(rest, true);
        }
        return false;
    }

    bool has_failed(SmallSet decides) const {
        return std::any_of(failed_.begin(), failed_.end(),
                           [decides](SmallSet failed) { return (decides & ~failed) == 0; });
    }

    /// The maximal candidates, those that decide most first, none that decides a subset of another's cases.
    void list_moves(SmallSet open, Moves& moves) const {
        const SmallSet in = open & set_;
        const SmallSet out = open & ~set_;
        std::array<std::uint8_t, kMostCubes> allowed{};
        for (const std::size_t i : cubes_.largest_first()) {
            const SmallSet cases = cubes_.cases(i);
            allowed[i] = ((cases & in) != 0) != ((cases & out) != 0) ? 1 : 0;
        }
        std::array<std::uint8_t, kMostCubes> is_widest = allowed;
        cubes_.remove_wider(allowed.data(), is_widest.data());
        Moves widest;
        for (const std::size_t i : cubes_.largest_first()) {
            if (is_widest[i] != 0) widest.list[widest.count++] = {cubes_.cases(i) & open, i};
        }
        std::stable_sort(
            widest.list.begin(), widest.list.begin() + static_cast<std::ptrdiff_t>(widest.count),
            [](const Move& a, const Move& b) { return std::popcount(a.decides) > std::popcount(b.decides); });
        for (std::size_t i = 0; i < widest.count; ++i) {
            const SmallSet decides = widest.list[i].decides;
            const auto end = moves.list.begin() + static_cast<std::ptrdiff_t>(moves.count);
            const bool is_part = std::any_of(moves.list.begin(), end, [decides](const Move& wide) {
                return (decides & ~wide.decides) == 0;
            });
            if (!is_part) moves.list[moves.count++] = widest.list[i];
        }
    }

    SmallSet set_;
    const Ternary& cubes_;
    Failures<SmallSet> failures_;
    std::vector<SmallSet> failed_;
    std::vector<ListedCube> path_;
    std::size_t nodes_ = 0;
};

}  // namespace

std::vector<ListedCube> least_list(SmallSet set, const Ternary& cubes, std::size_t fewer_than) {
    std::vector<ListedCube> best;
    ListSearch search(set, cubes);
    while (fewer_than > 1 && search.run(fewer_than - 1)) {
        best = search.list();
        fewer_than = best.size();
    }
    return best;
}

}  // namespace nplc::seqc
