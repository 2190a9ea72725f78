#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "lowering/order_plan.h"

namespace nplc::seqc {

/// A bit set of cases of a reduced step, up to 512; sized as needed.
class CaseSet {
  public:
    explicit CaseSet(std::size_t cases = 0) : words_((cases + 63) / 64) {}

    void insert(std::size_t c) { bits_[c / 64] |= std::uint64_t{1} << (c % 64); }
    bool contains(std::size_t c) const { return ((bits_[c / 64] >> (c % 64)) & 1U) != 0; }

    bool is_empty() const {
        std::uint64_t any = 0;
        for (std::size_t i = 0; i < words_; ++i) any |= bits_[i];
        return any == 0;
    }
    std::size_t size() const {
        std::size_t count = 0;
        for (std::size_t i = 0; i < words_; ++i) count += static_cast<std::size_t>(std::popcount(bits_[i]));
        return count;
    }
    bool is_within(const CaseSet& other) const {
        std::uint64_t outside = 0;
        for (std::size_t i = 0; i < words_; ++i) outside |= bits_[i] & ~other.bits_[i];
        return outside == 0;
    }
    CaseSet& operator|=(const CaseSet& other) {
        for (std::size_t i = 0; i < words_; ++i) bits_[i] |= other.bits_[i];
        return *this;
    }
    CaseSet& operator&=(const CaseSet& other) {
        for (std::size_t i = 0; i < words_; ++i) bits_[i] &= other.bits_[i];
        return *this;
    }
    CaseSet& remove(const CaseSet& other) {
        for (std::size_t i = 0; i < words_; ++i) bits_[i] &= ~other.bits_[i];
        return *this;
    }

    /// Calls `visit(case)` in ascending order.
    template <class Visit>
    void for_each(const Visit& visit) const {
        for (std::size_t i = 0; i < words_; ++i) {
            for (std::uint64_t rest = bits_[i]; rest != 0; rest &= rest - 1)
                visit(i * 64 + static_cast<std::size_t>(std::countr_zero(rest)));
        }
    }

  private:
    std::size_t words_;
    std::array<std::uint64_t, 8> bits_{};
};

/// The cases of a region of a reduced step with `inputs` inputs.
inline CaseSet cases_in(const Region& region, std::size_t inputs, std::size_t cases) {
    CaseSet set(cases);
    const std::size_t open = ((std::size_t{1} << inputs) - 1) & ~std::size_t{region.care};
    for (std::size_t zeros = region.zeros; zeros < cases >> inputs; zeros = (zeros + 1) | region.zeros) {
        std::size_t free = 0;
        do {
            set.insert(zeros << inputs | region.value | free);
            free = (free - open) & open;
        } while (free != 0);
    }
    return set;
}

}  // namespace nplc::seqc
