#include <fmt/format.h>

#include "views/cover10.h"
#include "views/words.h"

namespace nplc::seqc {
namespace {

/// The cases in which ERROR is `value`, taken for both values of it.
Truth where_error(const Truth& truth, bool value) {
    const Truth high = truth_of_bit(kErrorBit);
    constexpr std::size_t kStep = std::size_t{1} << kErrorBit;
    return value ? (truth & high) | ((truth & high) >> kStep) : (truth & ~high) | ((truth & ~high) << kStep);
}

std::string bit_name(std::size_t bit, const Symbols* symbols) {
    switch (bit) {
        case kInPosBit:
            return "INPOS";
        case kErrorBit:
            return "ERROR";
        case kTimerZero:
            return "TIMER.Q";
        case kCounterZero:
            return "COUNTER.Q";
        default:
            return input_name(bit, symbols);
    }
}

std::string product_text(Product product, const Symbols* symbols) {
    std::string text;
    for (std::size_t bit = 0; bit < kBits; ++bit) {
        if (((product.care >> bit) & 1) == 0) continue;
        const std::string name = bit_name(bit, symbols);
        append(text, ((product.value >> bit) & 1) != 0 ? name : "NOT " + name, " AND ");
    }
    return text;
}

/// "" if it always holds.
std::string sum_text(const Truth& need, const Truth& open, const Symbols* symbols, bool in_brackets) {
    const std::vector<Product> products = shortest_products(need, need | open);
    std::string text;
    for (const Product& product : products) append(text, product_text(product, symbols), " OR ");
    return in_brackets && products.size() > 1 ? "(" + text + ")" : text;
}

std::string after(std::string_view word, const std::string& rest) {
    return rest.empty() ? std::string(word) : fmt::format("{} AND {}", word, rest);
}

}  // namespace

std::string condition_text(const Truth& need, const Truth& open, const Symbols* symbols) {
    const Truth good = where_error(need, false);
    const Truth bad = where_error(need, true);
    if (need.none()) return "never";
    if (bad.none()) {
        const std::string text = sum_text(good, where_error(open, false), symbols, false);
        return text.empty() ? "always" : text;
    }
    if (good.none()) return after("ERROR", sum_text(bad, where_error(open, true), symbols, true));
    const Truth either = good | bad;
    const Truth allowed = where_error(need | open, false) & where_error(need | open, true);
    if ((either & ~allowed).none()) return after("ANY ERROR", sum_text(either, allowed, symbols, true));
    return sum_text(need, open, symbols, false);
}

}  // namespace nplc::seqc
