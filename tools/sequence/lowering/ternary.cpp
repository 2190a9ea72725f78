#include "lowering/ternary.h"

#include <algorithm>
#include <array>

namespace nplc::seqc {

Ternary::Ternary(std::size_t variables) {
    std::size_t size = 1;
    for (std::size_t v = 0; v < variables; ++v) {
        steps_.push_back(size);
        size *= 3;
    }
    entries_.resize(size);
    points_.resize(std::size_t{1} << variables);
    for (std::size_t index = 0; index < size; ++index) {
        Entry& entry = entries_[index];
        for (std::size_t v = 0; v < variables; ++v) {
            const std::size_t digit = index / steps_[v] % 3;
            if (digit == 2) continue;
            entry.care = static_cast<std::uint8_t>(entry.care | (1U << v));
            entry.value = static_cast<std::uint8_t>(entry.value | (digit << v));
        }
        if (entry.care + 1U == points_.size()) points_[entry.value] = index;
    }
    for (std::size_t v = 0; v < variables; ++v) {
        for (std::size_t above = 0; above < points_.size(); above += std::size_t{2} << v)
            blocks_.push_back({points_[above] + 2 * steps_[v], steps_[v]});
    }
}

const Ternary& Ternary::of(std::size_t variables) {
    static const std::vector<Ternary> all = [] {
        std::vector<Ternary> made;
        for (std::size_t v = 0; v <= kMostVariables; ++v) made.emplace_back(v);
        return made;
    }();
    return all[variables];
}

namespace {

constexpr std::size_t kAll = 7;

std::array<Points, kAll> make_ones() {
    std::array<Points, kAll> ones;
    for (std::size_t point = 0; point < kPoints; ++point) {
        for (std::size_t v = 0; v < kAll; ++v) ones[v][point] = ((point >> v) & 1U) != 0;
    }
    return ones;
}

/// The points where each variable is 1.
const std::array<Points, kAll>& ones() {
    static const std::array<Points, kAll> made = make_ones();
    return made;
}

}  // namespace

Points points_of(Cube cube) {
    const std::array<Points, kAll>& is_one = ones();
    Points points;
    points.set();
    for (std::size_t v = 0; v < kAll; ++v) {
        if (((cube.care >> v) & 1) == 0) continue;
        points &= ((cube.value >> v) & 1) != 0 ? is_one[v] : ~is_one[v];
    }
    return points;
}

Variables::Variables(std::initializer_list<const Points*> sets) {
    for (std::size_t v = 0; v < kAll; ++v) {
        const Points& one = ones()[v];
        const auto depends = [&](const Points* set) {
            return ((*set & one) >> (std::size_t{1} << v)) != (*set & ~one);
        };
        if (std::any_of(sets.begin(), sets.end(), depends)) bits_.push_back(static_cast<std::uint8_t>(v));
    }
}

std::uint8_t Variables::spread(std::size_t low) const {
    std::size_t wide = 0;
    for (std::size_t i = 0; i < bits_.size(); ++i) wide |= ((low >> i) & 1U) << bits_[i];
    return static_cast<std::uint8_t>(wide);
}

Points Variables::narrowed(const Points& set) const {
    if (bits_.size() == kAll) return set;
    Points result;
    for (std::size_t point = 0; point < std::size_t{1} << bits_.size(); ++point)
        result[point] = set.test(spread(point));
    return result;
}

Cube Variables::widened(Cube cube) const {
    return {spread(cube.value), spread(cube.care)};
}

}  // namespace nplc::seqc
