// TIMER.Q and COUNTER.Q in branches of one IF: a term can test neither "still runs", so a term for one of
// them also holds when both are zero.
#include <gtest/gtest.h>

#include <functional>

#include "support.h"

namespace nplc::seqc {
namespace {

struct Branch {
    std::string condition;
    std::function<bool(unsigned)> holds;
};

struct Effect {
    std::string text;
    test::Scan scan;
};

bool timer_zero(unsigned c) {
    return (c & 0x100U) != 0;
}
bool counter_zero(unsigned c) {
    return (c & 0x200U) != 0;
}
bool a(unsigned c) {
    return (c & 1U) != 0;
}

const Branch kTimer{"TIMER.Q", timer_zero};
const Branch kCounter{"COUNTER.Q", counter_zero};

const std::vector<Branch>& conditions() {
    static const std::vector<Branch> list = {
        kTimer,
        kCounter,
        {"TIMER.Q AND COUNTER.Q", [](unsigned c) { return timer_zero(c) && counter_zero(c); }},
        {"TIMER.Q OR COUNTER.Q", [](unsigned c) { return timer_zero(c) || counter_zero(c); }},
        {"TIMER.Q AND A", [](unsigned c) { return timer_zero(c) && a(c); }},
        {"COUNTER.Q AND A", [](unsigned c) { return counter_zero(c) && a(c); }},
        {"COUNTER.Q AND NOT A", [](unsigned c) { return counter_zero(c) && !a(c); }},
        {"A", a},
        {"NOT A", [](unsigned c) { return !a(c); }},
    };
    return list;
}

// The step S has OUT0 (1), T has OUT1 (2), U has none and enters with STOP (65h).
const std::vector<Effect>& effects() {
    static const std::vector<Effect> list = {
        {"NEXT := T;", {.next = 2, .outputs = 2}},
        {"NEXT := U;", {.next = 3, .outputs = 0, .sends = {"65"}}},
        {"CLEAR_IN_POS; NEXT := T;", {.next = 2, .outputs = 2, .sends = {"67"}}},
        {"V_SOLL := 100; NEXT := T;", {.next = 2, .outputs = 2, .sends = {"5=100"}}},
        {"TIMER := T#5s; NEXT := T;", {.next = 2, .outputs = 2, .timer = 5000}},
        {"COUNT_DOWN; NEXT := T;", {.next = 2, .outputs = 2, .counts = true}},
        {"TIMER := T#1s; COUNTER := 7; NEXT := U;",
         {.next = 3, .outputs = 0, .timer = 1000, .counter = 7, .sends = {"65"}}},
        {"EVERY_SCAN NOP;", {.outputs = 1, .sends = {"60"}}},
        {"EVERY_SCAN V_SOLL := 100;", {.outputs = 1, .sends = {"5=100"}}},
        {"EVERY_SCAN COUNTER := 100;", {.outputs = 1, .counter = 100}},
        {"EVERY_SCAN TIMER := T#5s;", {.outputs = 1, .timer = 5000}},
        {"EVERY_SCAN COUNT_DOWN;", {.outputs = 1, .counts = true}},
        {"EVERY_SCAN CLEAR_COUNTER;", {.outputs = 1, .clears = true}},
        {"NEXT := S;", {.outputs = 1}},
    };
    return list;
}

class Program {
  public:
    void add(const Branch& branch, const Effect& effect) {
        branches_.push_back(branch);
        effects_.push_back(effect);
    }
    void show_b() { shows_b_ = true; }

    std::string text() const {
        std::string body;
        for (std::size_t i = 0; i < branches_.size(); ++i) {
            body += (i == 0 ? "IF " : "ELSIF ") + branches_[i].condition + " THEN " + effects_[i].text + "\n";
        }
        return "PROGRAM P MOTOR MAC140; VAR_INPUT A AT IN0 : BOOL; B AT IN1 : BOOL; END_VAR\n"
               "STEP S: OWN ERROR; NO_HELPER; OUT OUT0;" +
               std::string(shows_b_ ? " OUT OUT2 WHEN B;" : "") + "\n" + body +
               "END_IF END_STEP\nSTEP T: OWN ERROR; OUT OUT1; END_STEP\n"
               "STEP U: OWN ERROR; ENTRY STOP; END_STEP\nEND_PROGRAM\n";
    }

    /// Which branch acts; -1: none. Conditions mean NOT ERROR.
    int branch_at(unsigned c) const {
        for (std::size_t i = 0; (c & 0x80U) == 0 && i < branches_.size(); ++i) {
            if (branches_[i].holds(c)) return static_cast<int>(i);
        }
        return -1;
    }

    int resting(unsigned c) const { return shows_b_ && (c & 0x82U) == 0x02U ? 5 : 1; }

    test::Scan wanted(unsigned c) const {
        const int branch = branch_at(c);
        test::Scan scan = branch < 0 ? test::Scan{} : effects_[static_cast<std::size_t>(branch)].scan;
        if (!scan.next) scan.outputs = resting(c);
        return scan;
    }

    /// What the table does; staying by name or writing the step's own outputs again is the same as nothing.
    test::Scan done(const Compilation& result, unsigned c) const {
        test::Scan scan = test::scan_case(result.table, 1, c);
        if (scan.next == 1) scan.next.reset();
        if (!scan.outputs) scan.outputs = shows_b_ ? -1 : 1;
        return scan;
    }

    /// A command or preset that a term without a test for "still runs" would let out where another branch
    /// acts, or that two terms would send when both are zero.
    bool is_impossible() const {
        const auto text_at = [&](unsigned c) {
            const int branch = branch_at(c);
            return branch < 0 ? std::string() : effects_[static_cast<std::size_t>(branch)].text;
        };
        for (unsigned c = 0; c < 1024; ++c) {
            const test::Scan scan = wanted(c);
            const std::string text = text_at(c);
            if (scan.sends.empty() && !scan.timer && !scan.counter) continue;
            for (unsigned zeros : {0x100U, 0x200U, 0x300U}) {
                if (text_at(c | zeros) != text) return true;
            }
            const unsigned input = c & 0xFFU;
            if (text_at(input | 0x100U) == text && text_at(input | 0x200U) == text && text_at(input) != text)
                return true;
        }
        return false;
    }

  private:
    std::vector<Branch> branches_;
    std::vector<Effect> effects_;
    bool shows_b_ = false;
};

/// Compiles and does as written in every case, or is refused with a reason: then true.
bool is_refused(const Program& program) {
    const std::string source = program.text();
    const Compilation result = compile(source);
    if (!result.ok) {
        for (const Diagnostic& d : result.diagnostics) {
            const bool reason = d.severity != Severity::error || d.code == "E071" || d.code == "E072";
            EXPECT_TRUE(reason) << test::shown(result, source) << source;
        }
        EXPECT_TRUE(program.is_impossible()) << test::shown(result, source) << source;
        return true;
    }
    for (unsigned c = 0; c < 1024; ++c) {
        const bool same = program.done(result, c) == program.wanted(c);
        EXPECT_TRUE(same) << "case " << c << "\n" << source << listing(result, source, "test.seq");
        if (!same) break;
    }
    return false;
}

TEST(Zeros, EveryPairInBothOrders) {
    int refused = 0;
    int compiled = 0;
    for (bool timer_first : {false, true}) {
        for (const Effect& first : effects()) {
            for (const Effect& second : effects()) {
                Program program;
                program.add(timer_first ? kTimer : kCounter, first);
                program.add(timer_first ? kCounter : kTimer, second);
                ++(is_refused(program) ? refused : compiled);
            }
        }
    }
    // Of the 14 effects 9 send or preset. As second branch each is refused beside the 13 others: 117. With
    // itself, 6 would send twice; 3 only preset, which may happen twice. Both orders: 2 * (117 + 6).
    EXPECT_EQ(refused, 246);
    EXPECT_EQ(compiled, 2 * 14 * 14 - 246);
}

TEST(Zeros, RandomChains) {
    int refused = 0;
    int compiled = 0;
    for (unsigned seed = 1; seed <= 500; ++seed) {
        SCOPED_TRACE(seed);
        test::Random random(seed);
        Program program;
        const unsigned branches = 2 + random() % 3;
        for (unsigned i = 0; i < branches; ++i) {
            program.add(conditions()[random() % conditions().size()], effects()[random() % effects().size()]);
        }
        if (random() % 3 == 0) program.show_b();
        ++(is_refused(program) ? refused : compiled);
        if (testing::Test::HasFailure()) return;
    }
    EXPECT_GT(compiled, 100);
    EXPECT_GT(refused, 100);
}

std::string codes_of(const std::string& branches) {
    return test::codes(compile(test::program("STEP S: NO_HELPER; OUT W; " + branches + " END_STEP")));
}

// With both at zero the term for the losing branch would send or preset all the same.
TEST(Zeros, TheLosingBranchMustNotAct) {
    EXPECT_EQ(codes_of("IF COUNTER.Q THEN CLEAR_IN_POS; NEXT := Other; ELSIF TIMER.Q THEN STOP; NEXT := "
                       "Fault; END_IF"),
              "E071");
    EXPECT_EQ(codes_of("IF TIMER.Q THEN CLEAR_IN_POS; NEXT := Other; ELSIF COUNTER.Q THEN STOP; NEXT := "
                       "Fault; END_IF"),
              "E071");
    EXPECT_EQ(codes_of("IF COUNTER.Q THEN NOP; NEXT := Other; ELSIF TIMER.Q THEN TIMER := T#5s; NEXT := "
                       "Fault; END_IF"),
              "E071");
    EXPECT_EQ(codes_of("IF TIMER.Q THEN NOP; NEXT := Other; ELSIF COUNTER.Q THEN TIMER := T#5s; NEXT := "
                       "Fault; END_IF"),
              "E071");
}

// The winning branch stays in its step: its term takes the other one's NEXT back, by naming the own step.
TEST(Zeros, TheWinningBranchStaysInItsStep) {
    for (bool timer_first : {false, true}) {
        const std::string first = timer_first ? "TIMER.Q" : "COUNTER.Q";
        const std::string second = timer_first ? "COUNTER.Q" : "TIMER.Q";
        for (const char* action : {"COUNTER := 100", "NOP", "V_SOLL := 1"}) {
            const std::string source =
                test::program("STEP S: OUT W; IF " + first + " THEN EVERY_SCAN " + action + "; ELSIF " +
                              second + " THEN NEXT := Other; END_IF END_STEP");
            const Compilation result = compile(source);
            ASSERT_TRUE(result.ok) << test::shown(result, source);
            const test::Scan both = test::scan(result.table, 1, 0, true, true);
            EXPECT_EQ(both.next.value_or(1), 1) << source;
            EXPECT_EQ(both.outputs, 1) << source;
            const test::Scan second_only = test::scan(result.table, 1, 0, !timer_first, timer_first);
            EXPECT_EQ(second_only, (test::Scan{.next = 2, .outputs = 2})) << source;
        }
    }
}

}  // namespace
}  // namespace nplc::seqc
