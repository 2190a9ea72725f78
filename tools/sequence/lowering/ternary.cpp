#include "lowering/ternary.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <tuple>
#include <utility>

namespace nplc::seqc {

Ternary::Ternary(std::size_t variables, std::size_t zeros) : inputs_(variables - zeros) {
    std::size_t size = 1;
    for (std::size_t v = 0; v < variables; ++v) {
        steps_.push_back(size);
        size *= 3;
    }
    cubes_.resize(size);
    points_.resize(std::size_t{1} << variables);
    for (std::size_t index = 0; index < size; ++index) {
        Product& cube = cubes_[index];
        for (std::size_t v = 0; v < variables; ++v) {
            const std::size_t digit = index / steps_[v] % 3;
            if (digit == 2) continue;
            cube.care = static_cast<std::uint16_t>(cube.care | (1U << v));
            cube.value = static_cast<std::uint16_t>(cube.value | (digit << v));
        }
        if (cube.care + 1U == points_.size()) points_[cube.value] = index;
    }
    for (std::size_t v = 0; v < variables; ++v) {
        for (std::size_t above = 0; above < points_.size(); above += std::size_t{2} << v)
            blocks_.push_back({points_[above] + 2 * steps_[v], steps_[v]});
    }
    if (variables <= kMostSorted) sort_by_size();
    if (variables > kMostSmall) return;
    cases_.resize(size);
    for (std::size_t point = 0; point < points_.size(); ++point)
        cases_[points_[point]] = SmallSet{1} << point;
    unite(cases_.data());
}

void Ternary::sort_by_size() {
    const auto is_testable = [&](std::size_t index) {
        return (cubes_[index].care & ~cubes_[index].value) >> inputs_ == 0;
    };
    const auto rank = [&](std::size_t index) {
        const Product& cube = cubes_[index];
        return std::tuple(std::popcount(cube.care), cube.care, cube.value);
    };
    for (std::size_t index = 0; index < cubes_.size(); ++index) {
        if (is_testable(index)) largest_first_.push_back(static_cast<std::uint16_t>(index));
    }
    std::sort(largest_first_.begin(), largest_first_.end(),
              [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
}

std::size_t Ternary::around(SmallSet cases) const {
    static constexpr std::array<SmallSet, kMostSmall> kOnes = {0xAAAAAAAA, 0xCCCCCCCC, 0xF0F0F0F0, 0xFF00FF00,
                                                               0xFFFF0000};
    std::size_t index = 0;
    for (std::size_t v = 0; v < steps_.size(); ++v) {
        if ((cases & ~kOnes[v]) == 0)
            index += steps_[v];
        else if (v >= inputs_ || (cases & kOnes[v]) != 0)
            index += 2 * steps_[v];
    }
    return index;
}

namespace {

template <std::size_t kIndex>
const Ternary& made() {
    constexpr std::size_t kZeros = kIndex / (Ternary::kMostVariables + 1);
    static const Ternary cubes(std::max(kIndex % (Ternary::kMostVariables + 1), kZeros), kZeros);
    return cubes;
}

template <std::size_t... kIndices>
const Ternary& made_at(std::size_t index, std::index_sequence<kIndices...> /*all*/) {
    static constexpr std::array<const Ternary& (*)(), sizeof...(kIndices)> kMakers = {&made<kIndices>...};
    return kMakers[index]();
}

/// The points where each variable is 1.
template <std::size_t kSize>
const std::vector<std::bitset<kSize>>& ones() {
    static const std::vector<std::bitset<kSize>> all = [] {
        std::vector<std::bitset<kSize>> sets(std::countr_zero(kSize));
        for (std::size_t point = 0; point < kSize; ++point) {
            for (std::size_t v = 0; v < sets.size(); ++v) sets[v][point] = ((point >> v) & 1U) != 0;
        }
        return sets;
    }();
    return all;
}

}  // namespace

const Ternary& Ternary::of(std::size_t variables, std::size_t zeros) {
    return made_at(zeros * (kMostVariables + 1) + variables,
                   std::make_index_sequence<3 * (kMostVariables + 1)>());
}

Points points_of(Cube cube) {
    Points points = Points().set();
    for (std::size_t v = 0; v < ones<kPoints>().size(); ++v) {
        if (((cube.care >> v) & 1) == 0) continue;
        const Points& one = ones<kPoints>()[v];
        points &= ((cube.value >> v) & 1) != 0 ? one : ~one;
    }
    return points;
}

template <std::size_t kSize>
Variables<kSize>::Variables(std::initializer_list<const Set*> sets) {
    for (std::size_t v = 0; v < ones<kSize>().size(); ++v) {
        const Set& one = ones<kSize>()[v];
        const auto depends = [&](const Set* set) {
            return ((*set & one) >> (std::size_t{1} << v)) != (*set & ~one);
        };
        if (std::any_of(sets.begin(), sets.end(), depends)) bits_.push_back(static_cast<std::uint8_t>(v));
    }
}

template <std::size_t kSize>
std::uint16_t Variables<kSize>::spread(std::size_t low) const {
    std::size_t wide = 0;
    for (std::size_t i = 0; i < bits_.size(); ++i) wide |= ((low >> i) & 1U) << bits_[i];
    return static_cast<std::uint16_t>(wide);
}

template <std::size_t kSize>
std::bitset<kSize> Variables<kSize>::narrowed(const Set& set) const {
    if (bits_.size() == ones<kSize>().size()) return set;
    Set result;
    for (std::size_t point = 0; point < std::size_t{1} << bits_.size(); ++point)
        result[point] = set.test(spread(point));
    return result;
}

template class Variables<kPoints>;
template class Variables<kCases>;

}  // namespace nplc::seqc
