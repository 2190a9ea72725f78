#include "report/decompile/formula.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace nplc::seqc {
namespace {

constexpr int kCostOfOr = 2;
constexpr int kCostOfStillRunning = 4;

using Products = std::vector<Product>;

int cost_of(Product product) {
    int cost = 0;
    for (std::size_t bit = 0; bit < kBits; ++bit) {
        if (!product.cares(bit)) continue;
        cost += bit >= kTimerZero && !product.wants(bit) ? kCostOfStillRunning : 1;
    }
    return cost;
}

/// Literals to drop first: those no term can test, then the least informative ones.
constexpr std::array<std::size_t, kBits> kDropOrder = {kErrorBit, kTimerZero, kCounterZero, 5, 4, 3, 2,
                                                       1,         0,          kInPosBit};

/// Removes literals that are not needed; negated ones first or last.
Product widened(Product product, const Truth& allowed, bool keep_wanted) {
    const auto drop = [&](bool wanted) {
        for (std::size_t bit : kDropOrder) {
            if (!product.cares(bit) || product.wants(bit) != wanted) continue;
            Product wider = product;
            wider.care &= static_cast<std::uint16_t>(~(1U << bit));
            wider.value &= wider.care;
            if ((truth_of(wider) & ~allowed).none()) product = wider;
        }
    };
    drop(!keep_wanted);
    drop(keep_wanted);
    return product;
}

Product best_around(std::size_t point, const Truth& open, const Truth& allowed) {
    const Product exact{static_cast<std::uint16_t>(point), (1U << kBits) - 1};
    const Product a = widened(exact, allowed, true);
    const Product b = widened(exact, allowed, false);
    const auto worth = [&](Product p) { return std::pair((truth_of(p) & open).count(), -cost_of(p)); };
    return worth(a) >= worth(b) ? a : b;
}

std::size_t first_case(const Truth& cases) {
    std::size_t point = 0;
    while (!cases.test(point)) ++point;
    return point;
}

Products cover(const Truth& need, const Truth& allowed) {
    Products products;
    for (Truth open = need; open.any(); open &= ~truth_of(products.back()))
        products.push_back(best_around(first_case(open), open, allowed));
    for (std::size_t i = products.size(); i-- > 0;) {
        Truth others;
        for (std::size_t k = 0; k < products.size(); ++k) {
            if (k != i) others |= truth_of(products[k]);
        }
        if ((need & ~others).none()) products.erase(products.begin() + static_cast<std::ptrdiff_t>(i));
    }
    return products;
}

/// Copies the half with or without ERROR to both.
Truth mirrored(const Truth& cases, bool error) {
    constexpr std::size_t kShift = std::size_t{1} << kErrorBit;
    return error ? (cases & truth_of_bit(kErrorBit)) | ((cases & truth_of_bit(kErrorBit)) >> kShift)
                 : (cases & ~truth_of_bit(kErrorBit)) | ((cases & ~truth_of_bit(kErrorBit)) << kShift);
}

std::string text_of(Product product, const BitNames& names) {
    std::string text;
    for (std::size_t bit = 0; bit < kBits; ++bit) {
        if (!product.cares(bit)) continue;
        const bool holds = product.wants(bit) != ((names.inverted >> bit & 1) != 0);
        text += (text.empty() ? "" : " AND ") + std::string(holds ? "" : "NOT ") + names.name[bit];
    }
    return text.empty() ? "TRUE" : text;
}

Formula formula_of(const Products& products, const BitNames& names) {
    Formula formula;
    for (const Product& product : products) {
        formula.text += (formula.text.empty() ? "" : " OR ") + text_of(product, names);
        formula.cost += cost_of(product) + kCostOfOr;
    }
    formula.is_true = products.size() == 1 && products.front().care == 0;
    return formula;
}

/// "ERROR AND ..." or "ANY ERROR AND ..." before a formula that does not name ERROR.
Formula with_error(Formula formula, const std::string& word, std::size_t products) {
    if (formula.is_true) {
        formula.text = word;
        formula.is_true = false;
    } else {
        formula.text = word + " AND " + (products > 1 ? "(" + formula.text + ")" : formula.text);
    }
    formula.cost += 1;
    return formula;
}

}  // namespace

Formula formula_of(const Truth& need, const Truth& allowed, const BitNames& names) {
    const Truth error = truth_of_bit(kErrorBit);
    const bool in_error = (need & error).any();
    const bool in_no_error = (need & ~error).any();
    if (!in_error || !in_no_error) {
        const Products products = cover(mirrored(need, in_error), mirrored(allowed, in_error));
        Formula formula = formula_of(products, names);
        return in_error ? with_error(std::move(formula), names.name[kErrorBit], products.size()) : formula;
    }
    const Truth both = mirrored(need, false) | mirrored(need, true);
    const Truth allowed_in_both = mirrored(allowed, false) & mirrored(allowed, true);
    if ((both & ~allowed_in_both).none()) {
        const Products products = cover(both, allowed_in_both);
        return with_error(formula_of(products, names), "ANY " + names.name[kErrorBit], products.size());
    }
    const Products products = cover(need, allowed);
    Formula formula = formula_of(products, names);
    const bool names_error =
        std::any_of(products.begin(), products.end(), [](const Product& p) { return p.cares(kErrorBit); });
    return names_error ? formula
                       : with_error(std::move(formula), "ANY " + names.name[kErrorBit], products.size());
}

}  // namespace nplc::seqc
