#include "semantics/truth.h"

#include <array>

namespace nplc::seqc {
namespace {

std::array<Truth, kBits> make_bits() {
    std::array<Truth, kBits> bits;
    for (std::size_t c = 0; c < kCases; ++c) {
        for (std::size_t b = 0; b < kBits; ++b) bits[b][c] = ((c >> b) & 1U) != 0;
    }
    return bits;
}

}  // namespace

Truth truth_of_bit(std::size_t bit) {
    static const std::array<Truth, kBits> bits = make_bits();
    return bits[bit];
}

Truth truth_of(Product product) {
    Truth truth = always();
    for (std::size_t bit = 0; bit < kBits; ++bit) {
        if (product.cares(bit)) truth &= product.wants(bit) ? truth_of_bit(bit) : ~truth_of_bit(bit);
    }
    return truth;
}

bool depends_on(const Truth& truth, std::size_t bit) {
    const Truth high = truth & truth_of_bit(bit);
    const Truth low = truth & ~truth_of_bit(bit);
    return high != (low << (std::size_t{1} << bit));
}

}  // namespace nplc::seqc
