#pragma once

#include <bitset>
#include <cstdint>
#include <vector>

#include "compiler/truth.h"

namespace nplc::seqc {

/// Inputs 0..5 in bits 0..5 and IN_POS in bit 6: the bits that can be don't care in a term, apart from timer
/// and counter.
inline constexpr std::size_t kPoints = 128;
using Points = std::bitset<kPoints>;

/// The points whose bits under `care` equal `value`.
struct Cube {
    std::uint8_t value = 0;
    std::uint8_t care = 0;
    bool operator==(const Cube&) const = default;
};

Points points_of(Cube cube);
inline Cube cube_of(Product product) {
    return {static_cast<std::uint8_t>(product.value), static_cast<std::uint8_t>(product.care)};
}

/// Minimum number of cubes that together cover all of `need` and nothing outside `allowed` (which contains
/// `need`). They may overlap. Exact up to a search limit; beyond it the best cover found.
std::vector<Cube> minimal_cover(const Points& need, const Points& allowed);

/// Minimum number of disjoint cubes that cover exactly `need`: for orders that must not be sent twice. Exact
/// up to a search limit; beyond it the best cover found.
std::vector<Cube> disjoint_cover(const Points& need);

/// Minimum number of products that together are true in all cases of `need` and in none outside of `allowed`
/// (which contains `need`), each as short as possible. For display: unlike a term's condition, they may
/// contain "timer not zero". Exact up to a search limit, beyond it greedy.
std::vector<Product> shortest_products(const Truth& need, const Truth& allowed);

}  // namespace nplc::seqc
