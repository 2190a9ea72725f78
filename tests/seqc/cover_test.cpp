#include "lowering/cover.h"

#include <gtest/gtest.h>

#include <functional>

#include "support.h"

namespace nplc::seqc {
namespace {

Points points(const std::function<bool(unsigned)>& holds) {
    Points set;
    for (unsigned p = 0; p < kPoints; ++p) set[p] = holds(p);
    return set;
}

Points union_of(const std::vector<Cube>& cubes) {
    Points all;
    for (unsigned p = 0; p < kPoints; ++p) {
        for (Cube cube : cubes) {
            if ((p & cube.care) == cube.value) all.set(p);
        }
    }
    return all;
}

bool bit(unsigned p, int n) {
    return ((p >> n) & 1U) != 0;
}

// Textbook functions with their known least number of products.
TEST(MinimalCover, KnownFunctions) {
    const auto count = [](const std::function<bool(unsigned)>& f) {
        const Points set = points(f);
        return minimal_cover(set, set).size();
    };
    EXPECT_EQ(count([](unsigned) { return false; }), 0U);
    EXPECT_EQ(count([](unsigned) { return true; }), 1U);
    EXPECT_EQ(count([](unsigned p) { return bit(p, 0) || bit(p, 1) || bit(p, 2); }), 3U);
    EXPECT_EQ(count([](unsigned p) { return bit(p, 0) != bit(p, 1); }), 2U);
    EXPECT_EQ(count([](unsigned p) { return bit(p, 0) != (bit(p, 1) != bit(p, 2)); }), 4U);
    EXPECT_EQ(count([](unsigned p) { return bit(p, 0) + bit(p, 1) + bit(p, 2) >= 2; }), 3U);  // majority
    // a'b + ab' + b'c + bc' : three products suffice (the cyclic core of three variables).
    EXPECT_EQ(count([](unsigned p) { return (p & 7U) != 0 && (p & 7U) != 7; }), 3U);
    // (a + b)(c + d) = ac + ad + bc + bd
    EXPECT_EQ(count([](unsigned p) { return (bit(p, 0) || bit(p, 1)) && (bit(p, 2) || bit(p, 3)); }), 4U);
    // Parity of seven: every second point by itself.
    EXPECT_EQ(count([](unsigned p) { return __builtin_parity(p) != 0; }), 64U);
}

TEST(MinimalCover, UsesWhatIsAllowed) {
    // a AND b needed, a AND NOT b allowed: a.
    const auto need = points([](unsigned p) { return bit(p, 0) && bit(p, 1); });
    const auto allowed = points([](unsigned p) { return bit(p, 0); });
    EXPECT_EQ(minimal_cover(need, allowed), (std::vector<Cube>{{1, 1}}));
}

TEST(DisjointCover, KnownFunctions) {
    const auto count = [](const std::function<bool(unsigned)>& f) {
        return disjoint_cover(points(f)).size();
    };
    EXPECT_EQ(count([](unsigned p) { return bit(p, 0) || bit(p, 1); }), 2U);               // a + a'b
    EXPECT_EQ(count([](unsigned p) { return bit(p, 0) || bit(p, 1) || bit(p, 2); }), 3U);  // a + a'b + a'b'c
    EXPECT_EQ(count([](unsigned p) { return (p & 7U) != 0 && (p & 7U) != 7; }), 3U);       // ab' + bc' + ca'
    EXPECT_EQ(count([](unsigned p) { return !(bit(p, 0) && bit(p, 1) && bit(p, 2)); }), 3U);
    EXPECT_EQ(count([](unsigned p) { return bit(p, 0) + bit(p, 1) + bit(p, 2) >= 2; }),
              3U);  // ab + ab'c + a'bc
}

TEST(Covers, HoldExactlyWhatTheyMust) {
    test::Random random(7);
    for (int round = 0; round < 300; ++round) {
        Points need;
        Points extra;
        const unsigned density = random() % 100;
        for (std::size_t p = 0; p < kPoints; ++p) {
            need[p] = random() % 100 < density;
            extra[p] = random() % 4 == 0;
        }
        const Points allowed = need | extra;
        const Points covered = union_of(minimal_cover(need, allowed));
        ASSERT_TRUE((need & ~covered).none()) << "seed 7, round " << round;
        ASSERT_TRUE((covered & ~allowed).none()) << "seed 7, round " << round;
        Points seen;
        for (Cube cube : disjoint_cover(need)) {
            ASSERT_TRUE((seen & points_of(cube)).none()) << "seed 7, round " << round;
            seen |= points_of(cube);
        }
        ASSERT_EQ(seen, need) << "seed 7, round " << round;
    }
}

// All 256 functions of three variables against an exhaustive search over sets of products.
TEST(MinimalCover, LeastForEveryFunctionOfThreeVariables) {
    std::vector<unsigned> products;  // as sets of the eight points
    for (unsigned care = 0; care < 8; ++care) {
        for (unsigned value = 0; value < 8; ++value) {
            if ((value & ~care) != 0) continue;
            unsigned set = 0;
            for (unsigned p = 0; p < 8; ++p) set |= (p & care) == value ? 1U << p : 0U;
            products.push_back(set);
        }
    }
    std::vector<unsigned> least(256, 99);
    least[0] = 0;
    for (int round = 0; round < 5; ++round) {
        const std::vector<unsigned> before = least;
        for (unsigned f = 0; f < 256; ++f) {
            for (unsigned product : products)
                least[f | product] = std::min(least[f | product], before[f] + 1);
        }
    }
    for (unsigned f = 0; f < 256; ++f) {
        const Points set = points([&](unsigned p) { return ((f >> (p & 7U)) & 1U) != 0; });
        EXPECT_EQ(minimal_cover(set, set).size(), least[f]) << f;
    }
}

std::vector<unsigned> products_of_four() {
    std::vector<unsigned> products;  // as sets of the sixteen points
    for (unsigned care = 0; care < 16; ++care) {
        for (unsigned value = 0; value < 16; ++value) {
            if ((value & ~care) != 0) continue;
            unsigned set = 0;
            for (unsigned p = 0; p < 16; ++p) set |= (p & care) == value ? 1U << p : 0U;
            products.push_back(set);
        }
    }
    return products;
}

// Every thirteenth function of four variables, the least number from the smaller functions inside it: a
// function is one product and, apart from it, what is left.
TEST(DisjointCover, LeastForFunctionsOfFourVariables) {
    const std::vector<unsigned> products = products_of_four();
    std::vector<unsigned> least(1U << 16U, 0);
    for (unsigned f = 1; f < least.size(); ++f) {
        least[f] = 99;
        for (unsigned product : products) {
            if ((product & ~f) == 0) least[f] = std::min(least[f], least[f & ~product] + 1);
        }
    }
    for (unsigned f = 0; f < least.size(); f += 13) {
        const Points set = points([&](unsigned p) { return ((f >> (p & 15U)) & 1U) != 0; });
        ASSERT_EQ(disjoint_cover(set).size(), least[f]) << f;
    }
}

// d, and where d is not: ab' + bc' + ca', which no question leaves whole. A tree has 1 + 4 leaves.
TEST(DisjointCover, FewerThanATreeOfQuestions) {
    const auto ring = points([](unsigned p) { return bit(p, 3) || ((p & 7U) != 0 && (p & 7U) != 7); });
    EXPECT_EQ(disjoint_cover(ring).size(), 4U);
}

}  // namespace
}  // namespace nplc::seqc
