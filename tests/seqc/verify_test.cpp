// The compiler's check of its own work finds every kind of wrong term.
#include "lowering/verify.h"

#include <gtest/gtest.h>

#include <functional>

namespace nplc::seqc {
namespace {

using sequencer::Term;

constexpr std::uint8_t kVerifiedStep = 1;
const std::vector<std::uint8_t> kVerifiedOutputs = {0, 1, 2};  // of POWER_UP, the step itself and step 2

/// "IF IN0 THEN STOP; TIMER := T#5ms; NEXT := 2" in a step whose output is OUT0.
StepPlan plan() {
    StepPlan step;
    step.name = "S";
    step.number = kVerifiedStep;
    step.outputs = 1;
    Rule rule;
    rule.when = truth_of_bit(kInput0) & ~truth_of_bit(kErrorBit);
    rule.action.next = std::uint8_t{2};
    rule.action.timer = std::uint16_t{5};
    rule.action.sends.push_back({nullptr, 0x65, 0, {}});
    step.rules.push_back(rule);
    return step;
}

Term right_term() {
    Term term;
    term.condition = {.step = kVerifiedStep, .input = 1, .care = 1};
    term.fast.next_step = 2;
    term.fast.outputs = 2;
    term.fast.sends = true;
    term.fast.command = 0x65;
    term.fast.preset = 5;
    return term;
}

std::optional<std::size_t> difference(const std::vector<Term>& terms) {
    std::vector<LoweredTerm> lowered;
    for (const Term& term : terms) lowered.push_back({sequencer::encode(term), {}});
    return first_difference(plan(), kVerifiedOutputs, lowered);
}

TEST(Verify, RightTermsPass) {
    EXPECT_FALSE(difference({right_term()}));
    // In two halves, by IN1.
    Term low = right_term();
    low.condition.care = 3;
    Term high = low;
    high.condition.input = 3;
    EXPECT_FALSE(difference({low, high}));
}

TEST(Verify, EveryWrongFieldIsFound) {
    const std::vector<std::function<void(Term&)>> faults = {
        [](Term& t) { t.fast.next_step = kVerifiedStep; },
        [](Term& t) { t.fast.next_step = sequencer::kNoSwitch; },
        [](Term& t) { t.fast.outputs = 1; },
        [](Term& t) { t.fast.sends = false; },
        [](Term& t) { t.fast.command = 0x67; },
        [](Term& t) { t.fast.preset = 6; },
        [](Term& t) { t.fast.preset = 0; },
        [](Term& t) { t.fast.presets_counter = true; },
        [](Term& t) { t.fast.clears_counter = true; },
        [](Term& t) { t.fast.counts_down = true; },
        [](Term& t) { t.condition.step = 2; },
        [](Term& t) { t.condition.needs_timer_zero = true; },
        [](Term& t) { t.condition.needs_counter_zero = true; },
        [](Term& t) { t.condition.input = 0; },
        [](Term& t) { t.condition.care = 3; },
        [](Term& t) { t.condition.care = 0; },
        [](Term& t) { t.condition.input |= sequencer::kError; },
    };
    for (std::size_t i = 0; i < faults.size(); ++i) {
        Term term = right_term();
        faults[i](term);
        EXPECT_TRUE(difference({term})) << "fault " << i;
    }
}

TEST(Verify, MissingAndSuperfluousTermsAreFound) {
    EXPECT_EQ(difference({}), 1U);                            // IN0 alone is the first case that needs one
    EXPECT_EQ(difference({right_term(), right_term()}), 1U);  // STOP twice
    Term both_zero = right_term();
    both_zero.condition.needs_timer_zero = true;
    both_zero.condition.needs_counter_zero = true;
    both_zero.fast.sends = false;
    both_zero.fast.next_step = sequencer::kEndOfTable - 2;
    EXPECT_EQ(difference({right_term(), both_zero}), 0x301U);  // IN0, timer and counter zero
}

TEST(Verify, ADifferenceIsAnErrorOfTheCompiler) {
    Report report;
    check_terms(plan(), kVerifiedOutputs, {}, report);
    ASSERT_TRUE(report.has_errors());
    EXPECT_EQ(report.take().front().code, "E099");
}

}  // namespace
}  // namespace nplc::seqc
