#pragma once

#include <cstdint>

namespace nplc::registers {

/// a * b / c to the nearest, halves away from zero, without intermediate overflow.
struct Quotient {
    bool fits = false;           ///< the quotient has at most 62 bits
    std::int64_t value = 0;      ///< rounded
    std::int64_t remainder = 0;  ///< a * b - value * c
};

/// `b` and `c` positive, `c` below 2^62.
Quotient divide_product(std::int64_t a, std::int64_t b, std::int64_t c);

}  // namespace nplc::registers
