// What a compiled step does in each of the 1,024 cases, against the program's own expressions evaluated here.
#include <gtest/gtest.h>

#include "support.h"

namespace nplc::seqc {
namespace {

/// A random condition with its text and its value.
struct Node {
    enum Kind { input, in_pos, error, any_error, timer, counter, constant, inverse, conj, disj, parity } kind;
    unsigned bit = 0;
    std::vector<Node> parts;

    std::string text() const {
        switch (kind) {
            case input:
                return std::string(1, static_cast<char>('A' + bit));
            case in_pos:
                return "INPOS";
            case error:
                return "ERROR";
            case any_error:
                return "ANY ERROR";
            case timer:
                return "TIMER.Q";
            case counter:
                return "COUNTER.Q";
            case constant:
                return bit != 0 ? "TRUE" : "FALSE";
            case inverse:
                return "NOT (" + parts[0].text() + ")";
            default:
                break;
        }
        const char* word = kind == conj ? " AND " : kind == disj ? " OR " : " XOR ";
        std::string joined;
        for (const Node& part : parts) joined += (joined.empty() ? "(" : word) + part.text();
        return joined + ")";
    }

    bool value(unsigned c) const {
        switch (kind) {
            case input:
                return ((c >> bit) & 1U) != 0;
            case in_pos:
                return (c & 0x40U) != 0;
            case error:
                return (c & 0x80U) != 0;
            case any_error:
                return true;
            case timer:
                return (c & 0x100U) != 0;
            case counter:
                return (c & 0x200U) != 0;
            case constant:
                return bit != 0;
            case inverse:
                return !parts[0].value(c);
            default:
                break;
        }
        unsigned ones = 0;
        for (const Node& part : parts) ones += part.value(c) ? 1U : 0U;
        if (kind == conj) return ones == parts.size();
        return kind == disj ? ones > 0 : ones % 2 == 1;
    }

    bool names_error() const {
        bool found = kind == error || kind == any_error;
        for (const Node& part : parts) found = found || part.names_error();
        return found;
    }
};

using test::Random;

struct Mix {
    bool zeros = true;  ///< TIMER.Q and COUNTER.Q may appear, un-negated
    bool inverse = true;
    bool errors = true;
};

Node random_node(Random& random, int depth, Mix mix) {
    const unsigned pick = random() % 16;
    if (depth == 0 || pick < 5) {
        if (mix.zeros && random() % 4 == 0) return {random() % 2 == 0 ? Node::timer : Node::counter, 0, {}};
        if (mix.errors && random() % 8 == 0)
            return {random() % 2 == 0 ? Node::error : Node::any_error, 0, {}};
        if (random() % 8 == 0) return {Node::in_pos, 0, {}};
        if (random() % 24 == 0) return {Node::constant, random() % 2, {}};
        Node leaf{Node::input, random() % 6, {}};
        return random() % 3 == 0 ? Node{Node::inverse, 0, {leaf}} : leaf;
    }
    if (pick < 7 && mix.inverse) return {Node::inverse, 0, {random_node(random, depth - 1, mix)}};
    Node node{pick < 11 ? Node::conj : pick < 15 || !mix.inverse ? Node::disj : Node::parity, 0, {}};
    const unsigned count = 2 + random() % 2;
    for (unsigned i = 0; i < count; ++i) node.parts.push_back(random_node(random, depth - 1, mix));
    return node;
}

bool holds(const Node& condition, unsigned c) {
    return condition.value(c) && (condition.names_error() || (c & 0x80U) == 0);
}

/// What a branch's statements do, as text and as the scan they must give.
struct Effect {
    std::string text;
    test::Scan scan;
};

// Outputs in step S are those of OUT0 (1); the steps T and U have OUT1 (2) and none (0), U enters with STOP.
Effect random_effect(Random& random) {
    switch (random() % 8) {
        case 0:
            return {"NEXT := T;", {.next = 2, .outputs = 2}};
        case 1:
            return {"NEXT := U;", {.next = 3, .outputs = 0, .sends = {"65"}}};
        case 2:
            return {"RESET_ERROR; NEXT := T;", {.next = 2, .outputs = 2, .sends = {"61"}}};
        case 3:
            return {"TIMER := T#300ms; NEXT := T;", {.next = 2, .outputs = 2, .timer = 300}};
        case 4:
            return {"COUNT_DOWN; NEXT := T;", {.next = 2, .outputs = 2, .counts = true}};
        case 5:
            return {"EVERY_SCAN CLEAR_COUNTER;", {.outputs = 1, .clears = true}};
        case 6:
            return {"TIMER := T#1s; COUNTER := 7; V_SOLL := 100; CLEAR_P_IST; NEXT := U;",
                    {.next = 3, .outputs = 0, .timer = 1000, .counter = 7, .sends = {"5=100", "63", "65"}}};
        default:
            return {"EVERY_SCAN CLEAR_IN_POS;", {.outputs = 1, .sends = {"67"}}};
    }
}

std::string around(const std::string& body) {
    return "PROGRAM P MOTOR MAC140; VAR_INPUT A AT IN0:BOOL; B AT IN1:BOOL; C AT IN2:BOOL; D AT IN3:BOOL; E "
           "AT "
           "IN4:BOOL; F AT IN5:BOOL; END_VAR\n"
           "STEP S: OWN ERROR; NO_HELPER; OUT OUT0;\n" +
           body +
           "\nEND_STEP\n"
           "STEP T: OWN ERROR; OUT OUT1; END_STEP\nSTEP U: OWN ERROR; ENTRY STOP; END_STEP\nEND_PROGRAM\n";
}

/// Whether a term without a test for "still runs" would act where it must not, or two terms would act at
/// once. What is sent or preset cannot be taken back, so this is what makes a program impossible.
bool is_impossible(const std::vector<Node>& conditions, const std::vector<Effect>& effects) {
    const auto branch_at = [&](unsigned c) {
        for (std::size_t i = 0; i < conditions.size(); ++i) {
            if (holds(conditions[i], c)) return static_cast<int>(i);
        }
        return -1;
    };
    const auto effect_at = [&](unsigned c) {
        const int branch = branch_at(c);
        return branch < 0 ? std::string() : effects[static_cast<std::size_t>(branch)].text;
    };
    for (unsigned c = 0; c < 1024; ++c) {
        const int branch = branch_at(c);
        if (branch < 0) continue;
        const test::Scan& scan = effects[static_cast<std::size_t>(branch)].scan;
        if (scan.sends.empty() && !scan.timer && !scan.counter) continue;
        const std::string text = effect_at(c);
        for (unsigned zeros : {0x100U, 0x200U, 0x300U}) {
            if (effect_at(c | zeros) != text) return true;
        }
        const bool from_timer = effect_at((c & 0xFFU) | 0x100U) == text;
        const bool from_counter = effect_at((c & 0xFFU) | 0x200U) == text;
        const bool from_neither = effect_at(c & 0xFFU) == text;
        if ((c & 0x300U) == 0x300U && from_timer && from_counter && !from_neither) return true;
    }
    return false;
}

/// Nothing, staying by name, and writing the step's own outputs again are the same to the machine.
test::Scan settled(test::Scan scan, int resting) {
    if (scan.next == 1) scan.next.reset();
    if (!scan.outputs) scan.outputs = resting;
    return scan;
}

TEST(Meaning, RandomBranches) {
    int compiled = 0;
    int refused = 0;
    for (unsigned seed = 1; seed <= 400; ++seed) {
        Random random(seed);
        const Mix mix{random() % 2 == 0, random() % 4 != 0, random() % 2 == 0};
        std::vector<Node> conditions;
        std::vector<Effect> effects;
        std::string body;
        const unsigned branches = 1 + random() % 4;
        for (unsigned i = 0; i < branches; ++i) {
            conditions.push_back(random_node(random, 3, mix));
            effects.push_back(random_effect(random));
            body += (i == 0 ? "IF " : "ELSIF ") + conditions.back().text() + " THEN " + effects.back().text +
                    "\n";
        }
        const std::string source = around(body + "END_IF");
        const Compilation result = compile(source);
        if (!result.ok) {
            for (const Diagnostic& d : result.diagnostics) {
                if (d.severity == Severity::error) {
                    ASSERT_TRUE(d.code == "E071" || d.code == "E072")
                        << test::shown(result, source) << source;
                }
            }
            ASSERT_TRUE(is_impossible(conditions, effects)) << test::shown(result, source) << source;
            ++refused;
            continue;
        }
        ++compiled;
        for (unsigned c = 0; c < 1024; ++c) {
            test::Scan wanted;
            for (unsigned i = 0; i < branches; ++i) {
                if (!holds(conditions[i], c)) continue;
                wanted = effects[i].scan;
                break;
            }
            ASSERT_EQ(settled(test::scan_case(result.table, 1, c), 1), settled(wanted, 1))
                << "seed " << seed << ", case " << c << "\n"
                << source << listing(result, source, "test.seq");
        }
    }
    EXPECT_GT(compiled, 200);
    EXPECT_GT(refused, 10);
}

// Two IFs beside each other are accepted exactly when no case makes both true, or both do the same.
TEST(Meaning, OverlapsAreFound) {
    int overlapping = 0;
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const Node first = random_node(random, 2, {false, true, true});
        const Node second = random_node(random, 2, {false, true, true});
        const bool same = random() % 4 == 0;
        const std::string source = around("IF " + first.text() + " THEN NEXT := T; END_IF\nIF " +
                                          second.text() + " THEN NEXT := " + (same ? "T" : "U") + "; END_IF");
        bool overlap = false;
        for (unsigned c = 0; c < 1024; ++c) overlap = overlap || (holds(first, c) && holds(second, c));
        const Compilation result = compile(source);
        ASSERT_EQ(result.ok, same || !overlap) << test::shown(result, source) << source;
        if (!result.ok) ++overlapping;
    }
    EXPECT_GT(overlapping, 50);
}

// Only next steps and outputs: everything can be overridden, so nothing may be refused.
TEST(Meaning, SwitchesAloneAlwaysCompile) {
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        std::string body;
        std::vector<Node> conditions;
        for (unsigned i = 0; i < 3; ++i) {
            conditions.push_back(random_node(random, 3, {}));
            body += (i == 0 ? "IF " : "ELSIF ") + conditions.back().text() +
                    " THEN NEXT := " + (i == 1 ? "S" : "T") + (i == 2 ? "; COUNT_DOWN;\n" : ";\n");
        }
        const std::string source = around(body + "END_IF");
        const Compilation result = compile(source);
        ASSERT_TRUE(result.ok) << test::shown(result, source);
        for (unsigned c = 0; c < 1024; ++c) {
            test::Scan wanted;
            if (holds(conditions[0], c))
                wanted = {.next = 2, .outputs = 2};
            else if (holds(conditions[1], c))
                wanted = {};
            else if (holds(conditions[2], c))
                wanted = {.next = 2, .outputs = 2, .counts = true};
            ASSERT_EQ(settled(test::scan_case(result.table, 1, c), 1), settled(wanted, 1))
                << "seed " << seed << ", case " << c << "\n"
                << source << listing(result, source, "test.seq");
        }
    }
}

// OUT ... WHEN follows its condition in every scan, whatever the branches do beside it.
TEST(Meaning, ConditionalOutputs) {
    int compiled = 0;
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        const Node first = random_node(random, 2, {});
        const Node second = random_node(random, 2, {});
        const Node branch = random_node(random, 2, {random() % 2 == 0, true, true});
        const Effect effect = random_effect(random);
        const std::string source =
            around("OUT OUT1 WHEN " + first.text() + "; OUT OUT2, OUT3 WHEN " + second.text() + ";\nIF " +
                   branch.text() + " THEN " + effect.text + " END_IF");
        const Compilation result = compile(source);
        if (!result.ok) continue;
        ++compiled;
        for (unsigned c = 0; c < 1024; ++c) {
            const int resting = 1 | (holds(first, c) ? 2 : 0) | (holds(second, c) ? 12 : 0);
            test::Scan wanted = holds(branch, c) ? effect.scan : test::Scan{};
            if (!wanted.next) wanted.outputs = resting;
            const test::Scan got = test::scan_case(result.table, 1, c);
            ASSERT_TRUE(got.outputs.has_value())
                << "nothing may latch; seed " << seed << ", case " << c << source;
            ASSERT_EQ(settled(got, resting), settled(wanted, resting))
                << "seed " << seed << ", case " << c << "\n"
                << source << listing(result, source, "test.seq");
        }
    }
    EXPECT_GT(compiled, 100);
}

}  // namespace
}  // namespace nplc::seqc
