// "never taken" and "no step leads to", held against what the compiled table can do from power-up on.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "support.h"

namespace nplc::seqc {
namespace {

constexpr unsigned kLevels = 16;  // of A, B, C and D; the programs look at nothing else but the timer
constexpr unsigned kTimerEnded = 0x100;

/// A literal; edges of a few inputs too, if `edges`.
std::string literal(test::Random& random, bool edges) {
    static const std::array<const char*, 3> kInputs = {"A", "B", "C"};
    const std::string input = kInputs[random() % kInputs.size()];
    switch (random() % (edges ? 5 : 2)) {
        case 0:
            return input;
        case 1:
            return "NOT " + input;
        case 2:
            return "F_TRIG(" + input + ")";
        default:
            return "R_TRIG(" + input + ")";
    }
}

std::string condition(test::Random& random, bool edges, unsigned depth = 2) {
    if (depth == 0 || random() % 3 == 0) return literal(random, edges);
    const std::string a = condition(random, edges, depth - 1);
    const std::string b = condition(random, edges, depth - 1);
    const std::string negation = random() % 5 == 0 ? "NOT " : "";
    return negation + "(" + a + (random() % 3 == 0 ? " OR " : " AND ") + b + ")";
}

/// Step S, whose branches lead to T0, T1 and so on, one each, a branch a line.
struct BranchProgram {
    explicit BranchProgram(unsigned seed) {
        test::Random random(seed);
        const bool edges = random() % 5 != 0;
        branches = 2 + random() % 3;
        const unsigned timing = random() % 4;  // FOR, WITHIN, WITHIN beside BLINKING, none
        remembers = edges || timing == 0 || timing == 2;
        std::string conditions;
        for (unsigned i = 0; i < branches; ++i) {
            const bool lasts = timing == 0 && i == 0;
            const bool is_limited = (timing == 1 || timing == 2) && i == 0;
            conditions += i == 0 ? "IF " : "ELSIF ";
            conditions += condition(random, edges && !lasts);
            conditions += lasts ? " FOR 5 ms" : is_limited ? " WITHIN 9 ms" : "";
            conditions += to(i);
        }
        if (timing == 1 || timing == 2 || random() % 4 == 0) conditions += "ELSE" + to(branches++);
        text =
            "PROGRAM P\nMOTOR MAC140;\nVAR_INPUT A AT IN0; B AT IN1; C AT IN2; D AT IN3; END_VAR\n"
            "STEP S: OWN ERROR; " +
            std::string(timing == 2 ? "OUT OUT0 BLINKING 4 ms;\n" : "\n") + conditions + "END_IF END_STEP\n";
        for (unsigned i = 0; i < branches; ++i)
            text += "STEP T" + std::to_string(i) + ": OWN ERROR; IF D THEN NEXT := S; END_IF END_STEP\n";
        text += "END_PROGRAM\n";
    }

    static std::string to(unsigned branch) { return " THEN NEXT := T" + std::to_string(branch) + ";\n"; }

    std::string text;
    unsigned branches = 0;
    bool remembers = false;  ///< S has a memory: of edges, of a time
};

/// Numbers of the steps that some course of inputs and timer enters.
std::set<int> entered(const std::vector<std::uint8_t>& table) {
    std::set<int> known = {0};
    std::vector<int> open = {0};
    while (!open.empty()) {
        const int from = open.back();
        open.pop_back();
        for (unsigned c = 0; c < 2 * kLevels; ++c) {
            const unsigned seen = c % kLevels | (c < kLevels ? 0 : kTimerEnded);
            const int to = test::scan_case(table, from, seen).next.value_or(from);
            if (known.insert(to).second) open.push_back(to);
        }
    }
    return known;
}

bool says(const Compilation& result, std::string_view code, std::string_view text, std::string_view at) {
    return std::any_of(result.diagnostics.begin(), result.diagnostics.end(), [&](const Diagnostic& d) {
        const std::size_t line = text.rfind('\n', d.span.offset) + 1;
        return d.code == code &&
               text.substr(line, text.find('\n', line) - line).find(at) != std::string::npos;
    });
}

TEST(NeverTaken, IsSaidOfTheBranchesThatNoCourseTakesAndOfNoOthers) {
    unsigned compiled = 0;
    unsigned dead = 0;
    unsigned told = 0;
    for (unsigned seed = 0; seed < NPLC_RANDOM_PROGRAMS; ++seed) {
        const BranchProgram program(seed);
        const Compilation result = compile(program.text);
        if (!result.ok) continue;
        ++compiled;
        const std::set<int> seen = entered(result.table);
        for (unsigned i = 0; i < program.branches; ++i) {
            const std::string name = "T" + std::to_string(i);
            const auto& steps = result.symbols.steps;
            const auto number = std::find(steps.begin(), steps.end(), name) - steps.begin();
            const bool is_entered = seen.count(static_cast<int>(number)) != 0;
            dead += is_entered ? 0 : 1;
            SCOPED_TRACE("seed " + std::to_string(seed) + ", branch to " + name + "\n" + program.text);
            const bool never = says(result, "W001", program.text, "NEXT := " + name + ";");
            const bool unreached = says(result, "W005", program.text, "STEP " + name + ":");
            ASSERT_EQ(never, unreached);
            if (never) {
                ASSERT_FALSE(is_entered);
                ++told;
            }
            // Only V001 reports which states of its memory a step comes to.
            if (!program.remembers) {
                ASSERT_EQ(never, !is_entered);
            }
        }
    }
    EXPECT_GT(compiled, NPLC_RANDOM_PROGRAMS / 4);
    EXPECT_GT(dead, NPLC_RANDOM_PROGRAMS / 10);
    EXPECT_GT(told, dead / 2);
}

TEST(NeverTaken, IsNotSaidOfATwoHandStart) {
    const std::string text =
        "PROGRAM P\nMOTOR MAC140;\nVAR_INPUT L AT IN0; R AT IN1; END_VAR\n"
        "STEP S: OWN ERROR; IF R_TRIG(L) AND R THEN NEXT := T; ELSIF R_TRIG(R) AND L THEN NEXT := U;\n"
        "ELSIF L AND R_TRIG(R) AND NOT R_TRIG(R) THEN NEXT := T; END_IF END_STEP\n"
        "STEP T: OWN ERROR; IF NOT L THEN NEXT := S; END_IF END_STEP\n"
        "STEP U: OWN ERROR; IF NOT L THEN NEXT := S; END_IF END_STEP\nEND_PROGRAM\n";
    const Compilation result = compile(text);
    ASSERT_TRUE(result.ok);
    EXPECT_EQ(test::codes(result), "W001");
    EXPECT_TRUE(says(result, "W001", text, "NOT R_TRIG(R)"));
}

}  // namespace
}  // namespace nplc::seqc
