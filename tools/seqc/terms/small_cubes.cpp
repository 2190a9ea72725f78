#include "terms/small_cubes.h"

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

}  // namespace nplc::seqc
