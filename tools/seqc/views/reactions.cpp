#include <algorithm>

#include "views/machine.h"

namespace nplc::seqc {
namespace {

/// What of an outcome makes a reaction different from others.
Reaction reaction_for(const Machine& machine, std::uint8_t step, const Outcome& outcome) {
    Reaction reaction{.when = {}, .outcome = outcome};
    const bool leaves = outcome.next != step;
    if (leaves && outcome.outputs)
        reaction.outputs_shown =
            static_cast<std::uint8_t>(kAllOutputs & ~machine.entered_with[outcome.next].known);
    if (reaction.outputs_shown == 0) {
        reaction.outcome.outputs.reset();
    } else {
        *reaction.outcome.outputs &= reaction.outputs_shown;
    }
    return reaction;
}

bool is_same(const Reaction& a, const Reaction& b) {
    return a.outputs_shown == b.outputs_shown && a.outcome == b.outcome;
}

void add_split_by_error(const Reaction& reaction, std::vector<Reaction>& reactions) {
    const Truth error = truth_of_bit(kErrorBit);
    Reaction good = reaction;
    Reaction bad = reaction;
    good.when &= ~error;
    bad.when &= error;
    const bool one = good.when.none() || bad.when.none() || !depends_on(reaction.when, kErrorBit);
    if (one) {
        reactions.push_back(reaction);
    } else {
        reactions.push_back(good);
        reactions.push_back(bad);
    }
}

}  // namespace

std::vector<Reaction> reactions_of(const Machine& machine, std::uint8_t step) {
    const StepBehaviour& behaviour = machine.steps[step];
    std::vector<Reaction> merged;
    std::vector<std::size_t> index_of;  // by outcome
    for (const Outcome& outcome : behaviour.outcomes) {
        const Reaction reaction = reaction_for(machine, step, outcome);
        const auto found = std::find_if(merged.begin(), merged.end(),
                                        [&](const Reaction& r) { return is_same(r, reaction); });
        index_of.push_back(static_cast<std::size_t>(found - merged.begin()));
        if (found == merged.end()) merged.push_back(reaction);
    }
    for (std::size_t c = 0; c < kCases; ++c) merged[index_of[behaviour.of_case[c]]].when.set(c);
    std::vector<Reaction> reactions;
    for (const Reaction& reaction : merged) {
        const bool idle = reaction.outcome.next == step && reaction.outcome.is_quiet();
        if (!idle) add_split_by_error(reaction, reactions);
    }
    return reactions;
}

}  // namespace nplc::seqc
