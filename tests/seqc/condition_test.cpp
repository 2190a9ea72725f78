// Conditions as people read them.
#include <gtest/gtest.h>

#include "lowering/cover.h"
#include "report/table_text.h"
#include "support.h"

namespace nplc::seqc {
namespace {

const Truth kA = truth_of_bit(kInput0);
const Truth kB = truth_of_bit(kInput0 + 1);
const Truth kC = truth_of_bit(kInput0 + 2);
const Truth kInPos = truth_of_bit(kInPosBit);
const Truth kError = truth_of_bit(kErrorBit);
const Truth kTimer = truth_of_bit(kTimerZero);
const Truth kCounter = truth_of_bit(kCounterZero);
const Truth kNoError = ~kError;

std::string text(const Truth& need, const Truth& open = {}) {
    return condition_text(need, open, nullptr);
}

TEST(ConditionText, NotErrorIsLeftOut) {
    EXPECT_EQ(text(kA & ~kB & kNoError), "IN0 AND NOT IN1");
    EXPECT_EQ(text(kTimer & kNoError), "TIMER.Q");
    EXPECT_EQ(text(kInPos & ~kTimer & ~kCounter & kNoError), "INPOS AND NOT TIMER.Q AND NOT COUNTER.Q");
    EXPECT_EQ(text(kNoError), "always");
    EXPECT_EQ(text({}), "never");
}

TEST(ConditionText, ErrorIsNamed) {
    EXPECT_EQ(text(kError), "ERROR");
    EXPECT_EQ(text(kError & kA), "ERROR AND IN0");
    EXPECT_EQ(text(kError & (kA | kB)), "ERROR AND (IN0 OR IN1)");
    EXPECT_EQ(text(always()), "ANY ERROR");
    EXPECT_EQ(text(kA), "ANY ERROR AND IN0");
    EXPECT_EQ(text(kA | kB), "ANY ERROR AND (IN0 OR IN1)");
    EXPECT_EQ(text(kA | kError), "IN0 OR ERROR");
    EXPECT_EQ(text((kA & kNoError) | (kB & kError)), "IN0 AND NOT ERROR OR IN1 AND ERROR");
}

TEST(ConditionText, IsAsShortAsItCanBe) {
    // ab + a'c + bc: the last is not needed.
    EXPECT_EQ(text(((kA & kB) | (~kA & kC) | (kB & kC)) & kNoError), "IN0 AND IN1 OR NOT IN0 AND IN2");
    // Cases in which it does not matter help.
    EXPECT_EQ(text(kA & kB & kNoError, kA & ~kB & kNoError), "IN0");
    EXPECT_EQ(text(kA & kNoError, kA & kError), "IN0");
}

TEST(ConditionText, UsesTheProgramsNames) {
    Symbols symbols;
    symbols.inputs = {"Start", "Guard", "", "", "", ""};
    EXPECT_EQ(condition_text(kA & ~kB & kNoError, {}, &symbols), "Start AND NOT Guard");
}

TEST(ShortestProducts, HoldWhatIsNeededAndNothingElse) {
    constexpr unsigned kSeed = 34;
    test::Random random(kSeed);
    for (int round = 0; round < 300; ++round) {
        Truth need;
        Truth open;
        for (unsigned i = 0; i < 1 + random() % 6; ++i) {  // a sum of random products
            Truth product = always();
            for (unsigned j = 0; j < 1 + random() % 4; ++j) {
                const Truth bit = truth_of_bit(random() % kBits);
                product &= random() % 2 == 0 ? bit : ~bit;
            }
            (random() % 3 == 0 ? open : need) |= product;
        }
        Truth held;
        for (const Product& product : shortest_products(need, need | open)) {
            for (std::size_t c = 0; c < kCases; ++c) {
                if ((c & product.care) == product.value) held.set(c);
            }
        }
        EXPECT_TRUE((need & ~held).none()) << "seed " << kSeed << ", round " << round;
        EXPECT_TRUE((held & ~(need | open)).none()) << "seed " << kSeed << ", round " << round;
    }
}

// Random tables of three variables against every choice of products: 8 points, 26 products.
TEST(ShortestProducts, AreTheFewest) {
    constexpr std::array<unsigned, 3> kBitsUsed{0, 6, 9};
    const auto spread = [&](unsigned points) {
        Truth truth;
        for (std::size_t c = 0; c < kCases; ++c) {
            unsigned point = 0;
            for (unsigned i = 0; i < 3; ++i) point |= static_cast<unsigned>((c >> kBitsUsed[i]) & 1U) << i;
            truth[c] = ((points >> point) & 1U) != 0;
        }
        return truth;
    };
    std::vector<unsigned> products;  // each as the set of its points
    for (unsigned care = 0; care < 8; ++care) {
        for (unsigned value = 0; value < 8; ++value) {
            if ((value & ~care) != 0) continue;
            unsigned points = 0;
            for (unsigned p = 0; p < 8; ++p) points |= (p & care) == value ? 1U << p : 0U;
            products.push_back(points);
        }
    }
    std::array<int, 256> fewest{};
    fewest.fill(99);
    fewest[0] = 0;
    for (int round = 0; round < 4; ++round) {  // no function of three variables needs more than four
        for (unsigned f = 0; f < 256; ++f) {
            for (const unsigned p : products) fewest[f | p] = std::min(fewest[f | p], fewest[f] + 1);
        }
    }
    for (unsigned f = 0; f < 256; ++f)
        EXPECT_EQ(shortest_products(spread(f), spread(f)).size(), static_cast<std::size_t>(fewest[f])) << f;
}

}  // namespace
}  // namespace nplc::seqc
