// The claim: a condition on up to five variables takes as few terms as any table, by a separate search
// without products and primes: tables from the last term back, and cases cut into cubes.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <unordered_map>

#include "support.h"

namespace nplc::seqc {
namespace {

using Set = std::uint32_t;  // of the cases of five variables

constexpr unsigned kVariables = 5;
constexpr unsigned kConditions = 60;

struct Condition {
    std::string text;
    Set holds = 0;
};

Set cases_of(unsigned variable) {
    Set set = 0;
    for (unsigned c = 0; c < 32; ++c) set |= ((c >> variable) & 1U) << c;
    return set;
}

Condition condition(test::Random& random, const std::array<std::string, kVariables>& names, unsigned depth) {
    if (depth == 0) {
        const unsigned variable = random() % kVariables;
        const bool negated = random() % 2 == 0;
        return {(negated ? "NOT " : "") + names[variable],
                negated ? ~cases_of(variable) : cases_of(variable)};
    }
    const Condition a = condition(random, names, depth - 1);
    const Condition b = condition(random, names, depth - 1);
    switch (random() % 5) {
        case 0:
            return {"(" + a.text + " XOR " + b.text + ")", a.holds ^ b.holds};
        case 1:
        case 2:
            return {"(" + a.text + " OR " + b.text + ")", a.holds | b.holds};
        default:
            return {"(" + a.text + " AND " + b.text + ")", a.holds & b.holds};
    }
}

/// All cubes; the variables from `inputs` on are zeros, which no term tests for "not yet".
std::vector<Set> cubes(unsigned inputs) {
    std::vector<Set> list;
    for (unsigned care = 0; care < 32; ++care) {
        for (unsigned value = 0; value < 32; ++value) {
            if ((value & ~care) != 0 || (care & ~value) >> inputs != 0) continue;
            Set set = 0;
            for (unsigned c = 0; c < 32; ++c) set |= (c & care) == value ? Set{1} << c : 0;
            list.push_back(set);
        }
    }
    return list;
}

/// Tables of terms that switch or stay, the last true one deciding.
class LeastTable {
  public:
    LeastTable(Set wanted, unsigned inputs) : wanted_(wanted), cubes_(cubes(inputs)) {}

    bool exists_with(unsigned terms) { return search(~Set{0}, terms); }

  private:
    bool search(Set open, unsigned terms) {
        if ((open & wanted_) == 0) return true;
        if (terms == 0) return false;
        const auto known = failed_.find(open);
        if (known != failed_.end() && known->second >= terms) return false;
        std::vector<Set> decided;
        for (const Set cube : cubes_) {
            const Set cases = cube & open;
            if (cases != 0 && ((cases & wanted_) == 0 || (cases & ~wanted_) == 0)) decided.push_back(cases);
        }
        std::sort(decided.begin(), decided.end(), [](Set a, Set b) {
            return std::popcount(a) != std::popcount(b) ? std::popcount(a) > std::popcount(b) : a < b;
        });
        std::vector<Set> tried;
        for (const Set cases : decided) {
            const bool is_part =
                std::any_of(tried.begin(), tried.end(), [cases](Set wider) { return (cases & ~wider) == 0; });
            if (is_part) continue;
            tried.push_back(cases);
            if (search(open & ~cases, terms - 1)) return true;
        }
        failed_[open] = terms;
        return false;
    }

    Set wanted_;
    std::vector<Set> cubes_;
    std::unordered_map<Set, unsigned> failed_;
};

/// Cubes that hold each case once.
class LeastPartition {
  public:
    unsigned of(Set open) {
        if (open == 0) return 0;
        const auto known = least_.find(open);
        if (known != least_.end()) return known->second;
        const Set first = open & -open;
        unsigned best = 32;
        for (const Set cube : cubes_) {
            if ((cube & first) != 0 && (cube & ~open) == 0) best = std::min(best, 1 + of(open & ~cube));
        }
        return least_[open] = best;
    }

  private:
    std::vector<Set> cubes_ = cubes(kVariables);
    std::unordered_map<Set, unsigned> least_;
};

unsigned terms_for(const Condition& condition, const std::string& command) {
    const std::string source = "PROGRAM P MOTOR MAC140; STEP S: OWN ERROR; IF " + condition.text + " THEN " +
                               command +
                               "NEXT := T; END_IF END_STEP STEP T: OWN ERROR; OUT OUT0; END_STEP END_PROGRAM";
    const Compilation result = compile(source);
    EXPECT_TRUE(result.ok) << test::shown(result, source);
    return static_cast<unsigned>(test::terms_of(result.table, 1));
}

void expect_least(const std::array<std::string, kVariables>& names, unsigned inputs) {
    for (unsigned seed = 1; seed <= kConditions; ++seed) {
        test::Random random(seed);
        const Condition wanted = condition(random, names, 2 + random() % 2);
        if (wanted.holds == 0) continue;
        SCOPED_TRACE("seed " + std::to_string(seed) + ": " + wanted.text);
        const unsigned terms = terms_for(wanted, "");
        EXPECT_FALSE(LeastTable(wanted.holds, inputs).exists_with(terms - 1)) << terms;
        if (inputs == kVariables) {
            EXPECT_EQ(terms_for(wanted, "STOP; "), LeastPartition().of(wanted.holds));
        }
    }
}

TEST(LeastCondition, FiveInputs) {
    expect_least({"IN0", "IN1", "IN2", "IN3", "INPOS"}, 5);
}

TEST(LeastCondition, FourInputsAndTheTimer) {
    expect_least({"IN0", "IN1", "IN2", "IN3", "TIMER.Q"}, 4);
}

TEST(LeastCondition, ThreeInputsTimerAndCounter) {
    expect_least({"IN0", "IN1", "IN2", "TIMER.Q", "COUNTER.Q"}, 3);
}

// From a random search: 8 terms each before.
TEST(LeastCondition, WhereOverridesAreHardToFind) {
    for (const auto& [holds, least] :
         std::vector<std::pair<Set, unsigned>>{{0xB7FC15B6, 7}, {0xB8B2D8EB, 7}}) {
        Condition wanted;
        wanted.holds = holds;
        for (unsigned c = 0; c < 32; ++c) {
            if (((holds >> c) & 1U) == 0) continue;
            wanted.text += wanted.text.empty() ? "" : " OR ";
            for (unsigned v = 0; v < kVariables; ++v)
                wanted.text += (v > 0 ? " AND " : "") + std::string(((c >> v) & 1U) != 0 ? "" : "NOT ") +
                               "IN" + std::to_string(v);
        }
        EXPECT_EQ(terms_for(wanted, ""), least);
        EXPECT_FALSE(LeastTable(holds, kVariables).exists_with(least - 1));
    }
}

}  // namespace
}  // namespace nplc::seqc
