#include "views/cover10.h"

#include <algorithm>
#include <bit>

#include "terms/cover_search.h"

namespace nplc::seqc {
namespace {

/// All products over some of the ten bits, as numbers with a digit a bit: 0 and 1 ask for that value, 2 for
/// none. A product is the union of the two with one digit 2 replaced by 0 and by 1.
class Products {
  public:
    Products(const Truth& need, const Truth& allowed) {
        for (std::size_t bit = 0; bit < kBits; ++bit) {
            if (depends_on(need, bit) || depends_on(allowed, bit)) bits_.push_back(bit);
        }
        for (std::size_t i = 0; i <= bits_.size(); ++i) powers_.push_back(i == 0 ? 1 : powers_.back() * 3);
        marks_.resize(powers_.back());
        for (std::size_t number = 0; number < marks_.size(); ++number) mark(number, need, allowed);
    }

    /// Those inside `allowed` that hold some of `need` and lie within no other, short ones first.
    std::vector<Product> primes() const {
        std::vector<Product> found;
        for (std::size_t number = 0; number < marks_.size(); ++number) {
            if (marks_[number] == (kInside | kUseful) && !is_within_another(number))
                found.push_back(product(number));
        }
        std::stable_sort(found.begin(), found.end(), [](const Product& a, const Product& b) {
            return std::popcount(a.care) < std::popcount(b.care);
        });
        return found;
    }

  private:
    static constexpr std::uint8_t kInside = 1;  // within `allowed`
    static constexpr std::uint8_t kUseful = 2;  // holds some of `need`

    std::size_t digit(std::size_t number, std::size_t place) const { return number / powers_[place] % 3; }

    void mark(std::size_t number, const Truth& need, const Truth& allowed) {
        for (std::size_t place = 0; place < bits_.size(); ++place) {
            if (digit(number, place) != 2) continue;
            const std::uint8_t one = marks_[number - powers_[place]];
            const std::uint8_t zero = marks_[number - 2 * powers_[place]];
            marks_[number] = static_cast<std::uint8_t>((one & zero & kInside) | ((one | zero) & kUseful));
            return;
        }
        const std::size_t c = product(number).value;
        marks_[number] =
            static_cast<std::uint8_t>((allowed.test(c) ? kInside : 0) | (need.test(c) ? kUseful : 0));
    }

    bool is_within_another(std::size_t number) const {
        for (std::size_t place = 0; place < bits_.size(); ++place) {
            const std::size_t wider = number + (2 - digit(number, place)) * powers_[place];
            if (wider != number && (marks_[wider] & kInside) != 0) return true;
        }
        return false;
    }

    Product product(std::size_t number) const {
        Product result;
        for (std::size_t place = 0; place < bits_.size(); ++place) {
            const auto bit = static_cast<std::uint16_t>(1U << bits_[place]);
            if (digit(number, place) != 2) result.care |= bit;
            if (digit(number, place) == 1) result.value |= bit;
        }
        return result;
    }

    std::vector<std::size_t> bits_;
    std::vector<std::size_t> powers_;
    std::vector<std::uint8_t> marks_;
};

Truth truth_of(Product product) {
    Truth truth = always();
    for (std::size_t bit = 0; bit < kBits; ++bit) {
        if (((product.care >> bit) & 1) == 0) continue;
        truth &= ((product.value >> bit) & 1) != 0 ? truth_of_bit(bit) : ~truth_of_bit(bit);
    }
    return truth;
}

/// By the first bit in which they differ: asked for, asked for not, not asked for.
bool comes_before(const Product& a, const Product& b) {
    for (std::size_t bit = 0; bit < kBits; ++bit) {
        const auto rank = [bit](const Product& p) {
            return ((p.care >> bit) & 1) == 0 ? 2 : ((p.value >> bit) & 1) != 0 ? 0 : 1;
        };
        if (rank(a) != rank(b)) return rank(a) < rank(b);
    }
    return false;
}

}  // namespace

std::vector<Product> shortest_products(const Truth& need, const Truth& allowed) {
    if (need.none()) return {};
    const std::vector<Product> primes = Products(need, allowed).primes();
    std::vector<Truth> useful;
    for (const Product& prime : primes) useful.push_back(truth_of(prime) & need);
    std::vector<std::size_t> chosen = CoverSearch<kCases>(need, std::move(useful)).run();
    std::vector<Product> cover;
    for (std::size_t i : chosen) cover.push_back(primes[i]);
    std::sort(cover.begin(), cover.end(), comes_before);
    return cover;
}

}  // namespace nplc::seqc
