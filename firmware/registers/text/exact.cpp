#include "exact.h"

namespace nplc::registers {
namespace {

constexpr std::uint64_t kLow = 0xFFFF'FFFF;

struct Wide {
    std::uint64_t high;
    std::uint64_t low;
};

Wide product(std::uint64_t a, std::uint64_t b) {
    const std::uint64_t low = (a & kLow) * (b & kLow);
    const std::uint64_t cross = (a >> 32) * (b & kLow) + (low >> 32);
    const std::uint64_t other = (a & kLow) * (b >> 32) + (cross & kLow);
    return {(a >> 32) * (b >> 32) + (cross >> 32) + (other >> 32), (other << 32) | (low & kLow)};
}

}  // namespace

Quotient divide_product(std::int64_t a, std::int64_t b, std::int64_t c) {
    const bool negative = a < 0;
    const std::uint64_t magnitude =
        negative ? 0 - static_cast<std::uint64_t>(a) : static_cast<std::uint64_t>(a);
    const auto divisor = static_cast<std::uint64_t>(c);
    const Wide n = product(magnitude, static_cast<std::uint64_t>(b));
    const Wide too_much = product(divisor, std::uint64_t{1} << 62);
    if (n.high > too_much.high || (n.high == too_much.high && n.low >= too_much.low)) return {};
    std::uint64_t rest = n.high;
    std::uint64_t quotient = 0;
    for (int bit = 63; bit >= 0; --bit) {
        rest = (rest << 1) | ((n.low >> bit) & 1);
        quotient <<= 1;
        if (rest >= divisor) {
            rest -= divisor;
            quotient |= 1;
        }
    }
    auto remainder = static_cast<std::int64_t>(rest);
    if (rest >= divisor - rest) {
        ++quotient;
        remainder -= c;
    }
    const auto value = static_cast<std::int64_t>(quotient);
    return {true, negative ? -value : value, negative ? -remainder : remainder};
}

}  // namespace nplc::registers
