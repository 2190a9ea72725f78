// Random programs against their meaning, evaluated case by case: what a table can do is compiled and
// does just that, what is refused no table can do.
#include <gtest/gtest.h>

#include <array>
#include <functional>

#include "seqc/decompile.h"
#include "support.h"

namespace nplc::seqc {
namespace {

constexpr unsigned kInputCases = 1024;
constexpr unsigned kPrograms = NPLC_RANDOM_PROGRAMS;
constexpr unsigned kError = 0x80;
constexpr unsigned kTimerEnded = 0x100;
constexpr unsigned kCounterEnded = 0x200;

struct Condition {
    std::string text;
    std::function<bool(unsigned)> holds;
};

Condition literal(test::Random& random) {
    static const std::array<std::pair<const char*, unsigned>, 10> kBits = {{{"A", 1},
                                                                            {"B", 2},
                                                                            {"C", 4},
                                                                            {"D", 8},
                                                                            {"E", 16},
                                                                            {"INPOS", 64},
                                                                            {"A", 1},
                                                                            {"B", 2},
                                                                            {"TIMER.Q", kTimerEnded},
                                                                            {"COUNTER.Q", kCounterEnded}}};
    const auto [name, bit] = kBits[random() % kBits.size()];
    const unsigned mask = bit;
    if (random() % 4 == 0)
        return {"NOT " + std::string(name), [mask](unsigned c) { return (c & mask) == 0; }};
    return {name, [mask](unsigned c) { return (c & mask) != 0; }};
}

Condition condition(test::Random& random, unsigned depth = 2) {
    if (depth == 0 || random() % 3 == 0) return literal(random);
    const Condition a = condition(random, depth - 1);
    const Condition b = condition(random, depth - 1);
    switch (random() % 4) {
        case 0:
            return {"(" + a.text + " OR " + b.text + ")",
                    [=](unsigned c) { return a.holds(c) || b.holds(c); }};
        case 1:
            return {"(" + a.text + " XOR " + b.text + ")",
                    [=](unsigned c) { return a.holds(c) != b.holds(c); }};
        case 2:
            return {"NOT (" + a.text + " AND " + b.text + ")",
                    [=](unsigned c) { return !(a.holds(c) && b.holds(c)); }};
        default:
            return {"(" + a.text + " AND " + b.text + ")",
                    [=](unsigned c) { return a.holds(c) && b.holds(c); }};
    }
}

struct ActionChoice {
    const char* text;
    test::Scan scan;
};

// S has OUT0 (1), T has OUT1 (2), U has none and enters with STOP (65h).
const std::vector<ActionChoice>& actions() {
    static const std::vector<ActionChoice> list = {
        {"NEXT := T;", {.next = 2, .outputs = 2}},
        {"NEXT := U;", {.next = 3, .outputs = 0, .sends = {"65"}}},
        {"CLEAR_IN_POS; NEXT := T;", {.next = 2, .outputs = 2, .sends = {"67"}}},
        {"V_SOLL := 100; STOP; NEXT := T;", {.next = 2, .outputs = 2, .sends = {"5=100", "65"}}},
        {"TIMER := T#5s; NEXT := T;", {.next = 2, .outputs = 2, .timer = 5000}},
        {"TIMER := T#1s; COUNTER := 7; NEXT := U;",
         {.next = 3, .outputs = 0, .timer = 1000, .counter = 7, .sends = {"65"}}},
        {"EVERY_SCAN CLEAR_IN_POS;", {.sends = {"67"}}},
        {"EVERY_SCAN NOP; EVERY_SCAN COUNT_DOWN;", {.counts = true, .sends = {"60"}}},
        {"EVERY_SCAN V_SOLL := 100;", {.sends = {"5=100"}}},
        {"EVERY_SCAN COUNTER := 100;", {.counter = 100}},
        {"EVERY_SCAN STOP; EVERY_SCAN TIMER := T#5s;", {.timer = 5000, .sends = {"65"}}},
        {"EVERY_SCAN CLEAR_COUNTER;", {.clears = true}},
    };
    return list;
}

class Program {
  public:
    explicit Program(unsigned seed) {
        test::Random random(seed);
        for (unsigned n = random() % 3; n > 0; --n) shown_.push_back(condition(random));
        const unsigned branches = 1 + random() % 3;
        for (unsigned i = 0; i < branches; ++i) {
            branches_.push_back(condition(random));
            actions_.push_back(&actions()[random() % actions().size()]);
        }
    }

    std::string text() const {
        std::string body;
        for (std::size_t i = 0; i < shown_.size(); ++i)
            body += "OUT OUT" + std::to_string(i + 2) + " WHEN " + shown_[i].text + "; ";
        for (std::size_t i = 0; i < branches_.size(); ++i)
            body += (i == 0 ? "\nIF " : "\nELSIF ") + branches_[i].text + " THEN " + actions_[i]->text;
        return "PROGRAM P MOTOR MAC140; VAR_INPUT A AT IN0; B AT IN1; C AT IN2; D AT IN3; E AT IN4; END_VAR\n"
               "STEP S: OWN ERROR; NO_HELPER; OUT OUT0; " +
               body +
               "\nEND_IF END_STEP\nSTEP T: OWN ERROR; OUT OUT1; END_STEP\n"
               "STEP U: OWN ERROR; ENTRY STOP; END_STEP\nEND_PROGRAM\n";
    }

    test::Scan wanted(unsigned c) const {
        const int branch = branch_at(c);
        test::Scan scan = branch < 0 ? test::Scan{} : actions_[static_cast<std::size_t>(branch)]->scan;
        if (scan.next) return scan;
        scan.next = 1;
        scan.outputs = 1;
        for (std::size_t i = 0; (c & kError) == 0 && i < shown_.size(); ++i) {
            if (shown_[i].holds(c)) *scan.outputs |= 4 << i;
        }
        return scan;
    }

    /// What the table does; outputs that it need not write are those of the step.
    test::Scan done(const Compilation& result, unsigned c) const {
        test::Scan scan = test::scan_case(result.table, 1, c);
        if (!scan.next) scan.next = 1;
        if (!scan.outputs && shown_.empty()) scan.outputs = 1;
        return scan;
    }

    /// A term that holds while timer or counter run holds at zero too, and two that each test one of them
    /// hold together at both. What a branch sends or presets there must be its own affair in all of these
    /// cases.
    bool is_possible() const {
        for (unsigned c = 0; c < kInputCases; ++c) {
            const int branch = branch_at(c);
            if (branch < 0) continue;
            const test::Scan& scan = actions_[static_cast<std::size_t>(branch)]->scan;
            if (scan.sends.empty() && !scan.timer && !scan.counter) continue;
            for (const unsigned zeros : {kTimerEnded, kCounterEnded}) {
                if (!acts_alike(c, c | zeros)) return false;
            }
            const unsigned running = c & ~(kTimerEnded | kCounterEnded);
            const bool twice = acts_alike(c, running | kTimerEnded) &&
                               acts_alike(c, running | kCounterEnded) && !acts_alike(c, running);
            if (twice && !scan.sends.empty()) return false;
        }
        return true;
    }

  private:
    /// Which branch acts; -1: none. Conditions mean NOT ERROR.
    int branch_at(unsigned c) const {
        for (std::size_t i = 0; (c & kError) == 0 && i < branches_.size(); ++i) {
            if (branches_[i].holds(c)) return static_cast<int>(i);
        }
        return -1;
    }

    bool acts_alike(unsigned c, unsigned other) const {
        const int a = branch_at(c);
        const int b = branch_at(other);
        return a == b || (a >= 0 && b >= 0 &&
                          actions_[static_cast<std::size_t>(a)] == actions_[static_cast<std::size_t>(b)]);
    }

    std::vector<Condition> shown_;
    std::vector<Condition> branches_;
    std::vector<const ActionChoice*> actions_;
};

TEST(RandomProgram, DoesWhatItSaysOrCannotBe) {
    unsigned compiled = 0;
    for (unsigned seed = 1; seed <= kPrograms; ++seed) {
        const Program program(seed);
        const std::string source = program.text();
        SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + source);
        const Compilation result = compile(source);
        EXPECT_EQ(result.ok, program.is_possible()) << test::shown(result, source);
        if (!result.ok) continue;
        ++compiled;
        for (unsigned c = 0; c < kInputCases; ++c)
            ASSERT_EQ(program.done(result, c), program.wanted(c)) << "case " << c;
        const Decompilation back = decompile(result.table, {.origin = "random.bin", .motor = {}});
        ASSERT_EQ(compile(back.text).table, result.table) << back.text;
    }
    EXPECT_GT(compiled, kPrograms / 2);
}

TEST(RandomProgram, OutputsThatFollowTheTimerBesideACommandThatDoesNot) {
    const std::string source = test::program(
        "STEP S: OUT Y WHEN TIMER.Q; IF A THEN EVERY_SCAN CLEAR_IN_POS; EVERY_SCAN COUNT_DOWN; END_IF "
        "END_STEP");
    const Compilation result = compile(source);
    ASSERT_TRUE(result.ok) << test::shown(result, source);
    for (unsigned inputs = 0; inputs < 2; ++inputs) {
        for (const bool zero : {false, true}) {
            test::Scan wanted{.outputs = zero ? 4 : 0};
            if (inputs == 1) wanted.sends = {"67"};
            wanted.counts = inputs == 1;
            EXPECT_EQ(test::scan(result.table, 1, inputs, zero, false), wanted) << inputs << zero;
        }
    }
}

}  // namespace
}  // namespace nplc::seqc
