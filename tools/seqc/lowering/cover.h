#pragma once

#include <bitset>
#include <cstdint>
#include <vector>

#include "semantics/truth.h"

namespace nplc::seqc {

/// Inputs 0..5 in bits 0..5 and IN_POS in bit 6: what a term may leave open, apart from timer and counter.
inline constexpr std::size_t kPoints = 128;
using Points = std::bitset<kPoints>;

/// The points whose bits under `care` equal `value`.
struct Cube {
    std::uint8_t value = 0;
    std::uint8_t care = 0;
    bool operator==(const Cube&) const = default;
};

Points points_of(Cube cube);

/// Fewest cubes that together hold all of `need` and nothing outside `allowed` (which contains `need`).
/// They may overlap. Exact up to a bound on the search; beyond it the fewest that were found.
std::vector<Cube> minimal_cover(const Points& need, const Points& allowed);

/// Fewest cubes that hold exactly `need`, no point twice: for what must not be sent twice. Exact up to a
/// bound on the search; beyond it the fewest that were found.
std::vector<Cube> disjoint_cover(const Points& need);

/// Fewest products that together hold in all cases of `need` and in none outside of `allowed` (which contains
/// `need`), each as short as possible. What the user reads: unlike a term's, they may ask for "timer not
/// zero". Exact up to a bound on the search, beyond it as few as a greedy choice finds.
std::vector<Product> shortest_products(const Truth& need, const Truth& allowed);

}  // namespace nplc::seqc
