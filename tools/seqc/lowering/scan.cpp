#include "lowering/scan.h"

#include <algorithm>

namespace nplc::seqc {
namespace {

using sequencer::Key;
using sequencer::Pending;
using sequencer::TermView;

CounterChange counter_change(const Pending& pending) {
    if ((pending.output_byte & 0x40) != 0) return CounterChange::clear;
    if (pending.counter_preset != 0) return CounterChange::preset;
    return (pending.output_byte & 0x80) != 0 ? CounterChange::count_down : CounterChange::none;
}

/// `own` are the step's terms.
ScanResult outcome_in(Key key, std::uint8_t step, const std::vector<TermView>& own) {
    Pending pending;
    ScanResult outcome;
    for (const TermView term : own) {
        if (!sequencer::is_true(term, key)) continue;
        if (!sequencer::is_flex(term)) pending.fold(term);
        if (sequencer::has_order(term)) outcome.orders.push_back(sequencer::order_of(term));
    }
    outcome.next = pending.next_step == sequencer::kNoSwitch ? step : pending.next_step;
    if (!pending.has_output) return outcome;
    outcome.outputs = static_cast<std::uint8_t>(pending.output_byte & 0x0F);
    outcome.timer = pending.timer_preset;
    outcome.counter = counter_change(pending);
    if (outcome.counter == CounterChange::preset) outcome.counter_preset = pending.counter_preset;
    return outcome;
}

}  // namespace

StepBehaviour behaviour_of(std::uint8_t step, std::span<const TermView> terms) {
    std::vector<TermView> own;
    std::copy_if(terms.begin(), terms.end(), std::back_inserter(own),
                 [&](TermView term) { return sequencer::step_of(term) == step; });
    StepBehaviour behaviour{.step = step, .terms = own.size(), .outcomes = {}, .of_case = {}};
    for (std::size_t c = 0; c < kCases; ++c) {
        ScanResult outcome = outcome_in(static_cast<Key>(c), step, own);
        auto found = std::find(behaviour.outcomes.begin(), behaviour.outcomes.end(), outcome);
        if (found == behaviour.outcomes.end()) found = behaviour.outcomes.insert(found, std::move(outcome));
        behaviour.of_case[c] = static_cast<std::uint16_t>(found - behaviour.outcomes.begin());
    }
    return behaviour;
}

}  // namespace nplc::seqc
