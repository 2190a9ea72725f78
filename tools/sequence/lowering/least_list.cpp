#include "lowering/least_list.h"

#include <algorithm>
#include <bit>
#include <deque>

namespace nplc::seqc {
namespace {

constexpr std::array<SmallSet, SmallCubes::kMostVariables> kOnes = {0xAAAAAAAA, 0xCCCCCCCC, 0xF0F0F0F0,
                                                                    0xFF00FF00, 0xFFFF0000};

std::size_t key_of(unsigned value, unsigned care) {
    return std::size_t{value} << SmallCubes::kMostVariables | care;
}

}  // namespace

SmallCubes::SmallCubes(std::size_t variables, std::size_t zeros)
    : variables_(variables), inputs_(variables - zeros) {
    const unsigned points = 1U << variables;
    for (unsigned care = 0; care < points; ++care) {
        for (unsigned value = 0; value < points; ++value) {
            if ((value & ~care) != 0 || (care & ~value) >> inputs_ != 0) continue;
            Entry entry;
            entry.value = static_cast<std::uint8_t>(value);
            entry.care = static_cast<std::uint8_t>(care);
            for (unsigned point = 0; point < points; ++point)
                entry.cases |= (point & care) == value ? SmallSet{1} << point : 0;
            list_.push_back(entry);
        }
    }
    std::stable_sort(list_.begin(), list_.end(), [](const Entry& a, const Entry& b) {
        return std::popcount(a.care) < std::popcount(b.care);
    });
    for (std::size_t i = 0; i < list_.size(); ++i) {
        Entry& entry = list_[i];
        index_.at(key_of(entry.value, entry.care)) = static_cast<std::uint8_t>(i);
        for (std::size_t v = 0; v < variables; ++v) {
            const unsigned bit = 1U << v;
            if ((entry.care & bit) == 0) continue;
            entry.wider.at(entry.wider_count++) = index_.at(key_of(entry.value & ~bit, entry.care & ~bit));
        }
    }
}

std::size_t SmallCubes::index_around(SmallSet cases) const {
    unsigned value = 0;
    unsigned care = 0;
    for (std::size_t v = 0; v < variables_; ++v) {
        const bool ones = (cases & ~kOnes[v]) == 0;
        if (!ones && (v >= inputs_ || (cases & kOnes[v]) != 0)) continue;
        care |= 1U << v;
        value |= ones ? 1U << v : 0U;
    }
    return index_[key_of(value, care)];
}

const SmallCubes& SmallCubes::of(std::size_t variables, std::size_t zeros) {
    static const std::deque<SmallCubes> all = [] {
        std::deque<SmallCubes> made;
        for (std::size_t z = 0; z <= 2; ++z) {
            for (std::size_t v = 0; v <= kMostVariables; ++v) made.emplace_back(std::max(v, z), z);
        }
        return made;
    }();
    return all[zeros * (kMostVariables + 1) + variables];
}

namespace {

constexpr std::size_t kMostCubes = 243;
constexpr unsigned kMemoBits = 15;
constexpr std::size_t kMostNodes = 20'000;

/// Cache of sets that are known to need more than a number of cubes.
class Failures {
  public:
    bool has(SmallSet set, std::size_t most) const {
        if (slots_.empty()) return false;
        const Slot& slot = slots_[place(set)];
        return slot.set == set && slot.most >= most;
    }
    void add(SmallSet set, std::size_t most) {
        if (slots_.empty()) slots_.resize(std::size_t{1} << kMemoBits);
        slots_[place(set)] = {set, static_cast<std::uint32_t>(most)};
    }

  private:
    struct Slot {
        SmallSet set = 0;
        std::uint32_t most = 0;
    };
    static std::size_t place(SmallSet set) { return set * 0x9E3779B1U >> (32U - kMemoBits); }

    std::vector<Slot> slots_;
};

/// From the last cube of the list to the first: a cube may be next if its open cases are all in or all out.
/// Placing one never removes options. So if a cube did not lead to a list, no list continues from there with
/// it, nor with one that decides a subset of its cases.
class ListSearch {
  public:
    ListSearch(SmallSet set, const SmallCubes& cubes) : set_(set), cubes_(cubes) {}

    bool run(std::size_t most) {
        path_.clear();
        failed_.clear();
        nodes_ = 0;
        return search(cubes_.all(), most);
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
        path_.push_back({&cubes_.list()[cube], in});
        return true;
    }

    bool search(SmallSet open, std::size_t most) {
        const SmallSet in = open & set_;
        const SmallSet out = open & ~set_;
        if (in == 0) return true;
        if (most == 0) return false;
        const std::size_t whole = cubes_.index_around(in);
        const SmallSet wrong = cubes_.list()[whole].cases & out;
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
        const std::size_t around_wrong = cubes_.index_around(wrong);
        if ((cubes_.list()[around_wrong].cases & in) == 0)
            return keep(around_wrong, false) && keep(whole, true);
        const SmallSet first = in & -in;
        for (std::size_t i = 0; i < cubes_.list().size(); ++i) {
            const SmallSet cases = cubes_.list()[i].cases;
            if ((cases & first) == 0 || (cases & out) != 0) continue;
            const std::size_t rest = cubes_.index_around(in & ~cases);
            if ((cubes_.list()[rest].cases & out) == 0) return keep(i, true) && keep(rest, true);
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
        std::array<std::uint8_t, kMostCubes> allowed;
        Moves widest;
        for (std::size_t i = 0; i < cubes_.list().size(); ++i) {
            const SmallCubes::Entry& cube = cubes_.list()[i];
            const bool has_in = (cube.cases & in) != 0;
            const bool has_out = (cube.cases & out) != 0;
            allowed[i] = has_in != has_out ? 1 : 0;
            if (allowed[i] == 0) continue;
            const auto end = cube.wider.begin() + cube.wider_count;
            const bool is_widest = std::none_of(cube.wider.begin(), end,
                                                [&](std::uint8_t wider) { return allowed[wider] != 0; });
            if (is_widest) widest.list[widest.count++] = {cube.cases & open, i};
        }
        std::sort(widest.list.begin(), widest.list.begin() + static_cast<std::ptrdiff_t>(widest.count),
                  [](const Move& a, const Move& b) {
                      const int more = std::popcount(a.decides) - std::popcount(b.decides);
                      return more != 0 ? more > 0 : a.cube < b.cube;
                  });
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
    const SmallCubes& cubes_;
    Failures failures_;
    std::vector<SmallSet> failed_;
    std::vector<ListedCube> path_;
    std::size_t nodes_ = 0;
};

class SlotSearch {
  public:
    SlotSearch(SmallSet set, const SmallCubes& cubes) : cubes_(cubes) { find_strangers(set); }

    bool run(SmallSet open, std::size_t most) {
        if (open == 0) return true;
        const SmallCubes::Entry& whole = cubes_.around(open);
        if (whole.cases == open && most > 0) {
            path_.push_back(&whole);
            return true;
        }
        const auto least =
            std::max<std::size_t>(2, static_cast<std::size_t>(std::popcount(open & strangers_)));
        if (most < least || failures_.has(open, most)) return false;
        const SmallSet lonely = most_constrained(open);
        for (const SmallCubes::Entry& cube : cubes_.list()) {
            if ((cube.cases & lonely) == 0 || (cube.cases & ~open) != 0) continue;
            path_.push_back(&cube);
            if (run(open & ~cube.cases, most - 1)) return true;
            path_.pop_back();
        }
        failures_.add(open, most);
        return false;
    }
    std::vector<const SmallCubes::Entry*> take() { return std::move(path_); }

  private:
    /// Finds an independent set: cases of which no two are in one cube inside `set`, so each needs its own
    /// cube.
    void find_strangers(SmallSet set) {
        for (SmallSet rest = set; rest != 0; rest &= rest - 1) {
            const SmallSet one = rest & -rest;
            bool is_stranger = true;
            for (SmallSet others = strangers_; others != 0 && is_stranger; others &= others - 1)
                is_stranger = (cubes_.around(one | (others & -others)).cases & ~set) != 0;
            if (is_stranger) strangers_ |= one;
        }
    }

    /// The open case contained in the fewest open cubes.
    SmallSet most_constrained(SmallSet open) const {
        std::array<std::uint8_t, 32> held{};
        for (const SmallCubes::Entry& cube : cubes_.list()) {
            if ((cube.cases & ~open) != 0) continue;
            for (SmallSet rest = cube.cases; rest != 0; rest &= rest - 1)
                ++held[static_cast<std::size_t>(std::countr_zero(rest))];
        }
        SmallSet best = open & -open;
        for (SmallSet rest = open; rest != 0; rest &= rest - 1) {
            const SmallSet one = rest & -rest;
            if (held[static_cast<std::size_t>(std::countr_zero(one))] <
                held[static_cast<std::size_t>(std::countr_zero(best))])
                best = one;
        }
        return best;
    }

    const SmallCubes& cubes_;
    SmallSet strangers_ = 0;
    Failures failures_;
    std::vector<const SmallCubes::Entry*> path_;
};

}  // namespace

std::vector<ListedCube> least_list(SmallSet set, const SmallCubes& cubes, std::size_t fewer_than) {
    std::vector<ListedCube> best;
    ListSearch search(set, cubes);
    while (fewer_than > 1 && search.run(fewer_than - 1)) {
        best = search.list();
        fewer_than = best.size();
    }
    return best;
}

std::vector<const SmallCubes::Entry*> least_partition(SmallSet set, const SmallCubes& cubes,
                                                      std::size_t fewer_than) {
    std::vector<const SmallCubes::Entry*> best;
    while (fewer_than > 1) {
        SlotSearch search(set, cubes);
        if (!search.run(set, fewer_than - 1)) break;
        best = search.take();
        fewer_than = best.size();
    }
    return best;
}

}  // namespace nplc::seqc
