#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>

namespace nplc::seqc {

/// The bits that a term can test, as bit numbers of a case: the input image of 001 §6.1.9, then the two zero
/// flags.
enum Bit : std::size_t {
    kInput0 = 0,
    kInPosBit = 6,
    kErrorBit = 7,
    kTimerZero = 8,
    kCounterZero = 9,
    kBits = 10
};

inline constexpr std::size_t kCases = 1U << kBits;

/// A condition as the set of cases in which it is true.
using Truth = std::bitset<kCases>;

Truth truth_of_bit(std::size_t bit);
inline Truth always() {
    return Truth().set();
}

/// A product (implicant): the cases whose bits under `care` equal `value`.
struct Product {
    std::uint16_t value = 0;
    std::uint16_t care = 0;

    bool cares(std::size_t bit) const { return ((care >> bit) & 1U) != 0; }
    bool wants(std::size_t bit) const { return ((value >> bit) & 1U) != 0; }
    bool operator==(const Product&) const = default;
};

Truth truth_of(Product product);

/// Whether the condition's value ever depends on `bit`.
bool depends_on(const Truth& truth, std::size_t bit);

}  // namespace nplc::seqc
