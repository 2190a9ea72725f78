#include "terms/ternary.h"

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

}  // namespace nplc::seqc
