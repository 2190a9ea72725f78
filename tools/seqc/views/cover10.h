#pragma once

#include <cstdint>
#include <vector>

#include "meaning/truth.h"

namespace nplc::seqc {

/// The cases whose bits under `care` equal `value`; any of the ten bits.
struct Product {
    std::uint16_t value = 0;
    std::uint16_t care = 0;
    bool operator==(const Product&) const = default;
};

/// Fewest products that together hold in all cases of `need` and in none outside of `allowed` (which contains
/// `need`), each as short as possible. What a person reads: unlike a term's, they may ask for "timer not
/// zero". Exact up to a bound on the search, beyond it as few as a greedy choice finds.
std::vector<Product> shortest_products(const Truth& need, const Truth& allowed);

}  // namespace nplc::seqc
