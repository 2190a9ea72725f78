#include "compiler/truth.h"

#include "table/step.h"

namespace nplc::seqc {

Truth truth_of_bit(std::size_t bit) {
    return table::cases_with(static_cast<unsigned>(bit));
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
