// What the search over terms finds is right by itself, not only because wrong forms are thrown away.
#include "lowering/shorten.h"

#include <gtest/gtest.h>

#include "lowering/verify.h"
#include "support.h"

namespace nplc::seqc {
namespace {

constexpr std::uint8_t kStep = 1;
const std::vector<std::uint8_t> kOutputs = {0, 1, 2, 2, 4};

/// Rules that never hold together, over some inputs and both zeros; each may send, preset, count and switch.
StepPlan random_step(test::Random& random) {
    StepPlan step;
    step.name = "S";
    step.number = kStep;
    step.outputs = 1;
    const unsigned bits = random() & 0x7FU & random();
    const unsigned zeros = random() % 3 == 0 ? random() & 3U : 0;
    const std::size_t rules = random() % 5;
    std::vector<unsigned> owner(kCases);
    std::vector<unsigned> drawn(kCases);
    for (unsigned& d : drawn) d = random();
    for (std::size_t c = 0; c < kCases; ++c) {
        const std::size_t key = c & (bits | 0x80U | zeros << kTimerZero);
        owner[c] = drawn[key] % 5;
    }
    for (std::size_t r = 0; r < rules; ++r) {
        Rule rule;
        for (std::size_t c = 0; c < kCases; ++c) rule.when[c] = owner[c] == r;
        if (rule.when.none()) continue;
        if (random() % 3 != 0) rule.action.next = static_cast<std::uint8_t>(1 + random() % 4);
        // Orders and presets only where no zero is asked for: nothing could take them back.
        const unsigned sends = zeros != 0 ? 0 : random() % 4;
        for (unsigned i = 0; i < sends; ++i)
            rule.action.sends.push_back({nullptr, static_cast<std::uint8_t>(0x60 + random() % 3), 0, {}});
        if (zeros == 0 && random() % 3 == 0) rule.action.timer = static_cast<std::uint16_t>(1 + random() % 2);
        if (zeros == 0 && random() % 4 == 0) {
            rule.action.counter = static_cast<std::uint16_t>(1 + random() % 2);
        } else {
            rule.action.counts_down = random() % 4 == 0;
        }
        if (!rule.action.is_empty()) step.rules.push_back(rule);
    }
    if (random() % 3 == 0) {
        ConditionalOutput output{4, {}};
        for (std::size_t c = 0; c < kCases; ++c) output.when[c] = (drawn[c & (bits | 0x80U)] & 0x100U) != 0;
        step.conditional.push_back(output);
    }
    return step;
}

TEST(Shorten, RandomStepsDoWhatTheRulesSay) {
    int found = 0;
    for (unsigned seed = 1; seed <= 400; ++seed) {
        SCOPED_TRACE(seed);
        test::Random random(seed);
        const StepPlan step = random_step(random);
        std::vector<LoweredTerm> terms;
        bool complete = true;
        for (const ReducedStep& error_branch : error_branches_of(step, kOutputs)) {
            const std::vector<LoweredTerm> own = shorten(error_branch, 1'000);
            bool needs_terms = false;
            for (const Behaviour& behaviour : error_branch.behaviours) {
                needs_terms = needs_terms || behaviour.writes || behaviour.sends() != 0 ||
                              behaviour.timer() != 0 || behaviour.counter() != 0;
            }
            complete = complete && own.empty() != needs_terms;
            terms.insert(terms.end(), own.begin(), own.end());
        }
        if (!complete) continue;
        ++found;
        const auto different = first_difference(step, kOutputs, terms);
        EXPECT_FALSE(different.has_value()) << "case " << different.value_or(0);
    }
    EXPECT_GT(found, 300);
}

}  // namespace
}  // namespace nplc::seqc
