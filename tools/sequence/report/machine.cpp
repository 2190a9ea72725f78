#include "report/machine.h"

#include <algorithm>

namespace nplc::seqc {
namespace {

KnownOutputs after(const table::Outcome& outcome, const KnownOutputs& before) {
    return outcome.outputs ? KnownOutputs{kAllOutputs, *outcome.outputs} : before;
}

KnownOutputs joined(const KnownOutputs& a, const KnownOutputs& b) {
    const auto known = static_cast<std::uint8_t>(a.known & b.known & ~(a.value ^ b.value));
    return {known, static_cast<std::uint8_t>(a.value & known)};
}

/// Follows all transitions from power-up until nothing changes.
class Walk {
  public:
    explicit Walk(Machine& machine) : machine_(machine) {
        arrive(0, {kAllOutputs, 0}, machine_.entered_with, machine_.reachable);
        arrive(0, {kAllOutputs, 0}, machine_.held, held_);
        while (!open_.empty()) {
            const std::uint8_t step = open_.back();
            open_.pop_back();
            for (const table::Outcome& outcome : machine_.steps[step].outcomes) follow(step, outcome);
        }
    }

  private:
    void follow(std::uint8_t step, const table::Outcome& outcome) {
        const KnownOutputs outputs = after(outcome, machine_.held[step]);
        if (outcome.next != step) arrive(outcome.next, outputs, machine_.entered_with, machine_.reachable);
        arrive(outcome.next, outputs, machine_.held, held_);
    }

    void arrive(std::uint8_t step, const KnownOutputs& outputs, std::array<KnownOutputs, kStepNumbers>& known,
                std::bitset<kStepNumbers>& seen) {
        const KnownOutputs merged = seen.test(step) ? joined(known[step], outputs) : outputs;
        if (seen.test(step) && merged == known[step]) return;
        seen.set(step);
        known[step] = merged;
        open_.push_back(step);
    }

    Machine& machine_;
    std::bitset<kStepNumbers> held_;
    std::vector<std::uint8_t> open_;
};

}  // namespace

Machine machine_of(std::span<const std::uint8_t> table) {
    const std::vector<sequencer::TermView> terms = table::terms_of(table);
    Machine machine;
    machine.terms = terms.size();
    machine.used.set(0);
    for (std::uint8_t step = 0; step < kStepNumbers; ++step) {
        machine.steps[step] = table::step_of(step, terms);
        if (machine.steps[step].terms == 0) continue;
        machine.used.set(step);
        for (const table::Outcome& outcome : machine.steps[step].outcomes) machine.used.set(outcome.next);
    }
    Walk walk(machine);
    return machine;
}

namespace {

/// The cases in which a step that stays switches one output on, off, or keeps it.
struct Writes {
    Truth on;
    Truth off;
    Truth kept;
    Truth leaves;
};

Writes writes_of(const table::Step& behaviour, std::uint8_t bit) {
    Writes writes;
    for (std::size_t c = 0; c < kCases; ++c) {
        const table::Outcome& outcome = behaviour.in(c);
        if (outcome.next != behaviour.number) {
            writes.leaves.set(c);
        } else if (!outcome.outputs) {
            writes.kept.set(c);
        } else {
            (((*outcome.outputs >> bit) & 1) != 0 ? writes.on : writes.off).set(c);
        }
    }
    return writes;
}

void add_rules(const Machine& machine, std::uint8_t step, std::uint8_t bit, std::vector<OutputRule>& rules) {
    using Kind = OutputRule::Kind;
    const KnownOutputs& held = machine.held[step];
    const Writes writes = writes_of(machine.steps[step], bit);
    if (((held.known >> bit) & 1) != 0) {
        if (((held.value >> bit) & 1) != 0) rules.push_back({bit, Kind::on, {}, {}});
        return;
    }
    if (writes.kept.none()) {
        if (writes.on.any())
            rules.push_back({bit, writes.off.any() ? Kind::follows : Kind::on, writes.on, writes.leaves});
        return;
    }
    if (writes.on.any()) rules.push_back({bit, Kind::sets, writes.on, writes.leaves});
    if (writes.off.any()) rules.push_back({bit, Kind::resets, writes.off, writes.leaves});
}

/// A transition into a step.
struct Way {
    std::uint8_t from = 0;
    const table::Outcome* outcome = nullptr;
};

std::vector<Way> ways_into(const Machine& machine, std::uint8_t step) {
    std::vector<Way> ways;
    for (std::uint8_t from = 0; from < kStepNumbers; ++from) {
        if (from == step) continue;
        for (const table::Outcome& outcome : machine.steps[from].outcomes) {
            const bool is_known = std::any_of(ways.begin(), ways.end(), [&](const Way& way) {
                return way.from == from && *way.outcome == outcome;
            });
            if (outcome.next == step && !is_known) ways.push_back({from, &outcome});
        }
    }
    return ways;
}

template <class Iterator>
std::size_t common_length(Iterator a, Iterator a_end, Iterator b, Iterator b_end) {
    return static_cast<std::size_t>(std::mismatch(a, a_end, b, b_end).first - a);
}

}  // namespace

std::vector<OutputRule> output_rules(const Machine& machine, std::uint8_t step) {
    std::vector<OutputRule> rules;
    for (std::uint8_t bit = 0; bit < 4; ++bit) add_rules(machine, step, bit, rules);
    return rules;
}

Entry entry_of(const Machine& machine, std::uint8_t step) {
    if (step == 0) return {};  // a power-up sends nothing
    const std::vector<Way> ways = ways_into(machine, step);
    const bool from_others =
        std::any_of(ways.begin(), ways.end(), [](const Way& way) { return way.from != 0; });
    if (ways.size() < 2 || !from_others) return {};
    const table::Outcome& first = *ways.front().outcome;
    std::size_t common = first.orders.size();
    Entry entry{.orders = {}, .timer = first.timer, .counter_preset = first.counter_preset};
    for (const Way& way : ways) {
        const table::Outcome& outcome = *way.outcome;
        common = std::min(common, common_length(first.orders.rbegin(), first.orders.rend(),
                                                outcome.orders.rbegin(), outcome.orders.rend()));
        if (outcome.timer != entry.timer) entry.timer = 0;
        if (outcome.counter_preset != entry.counter_preset) entry.counter_preset = 0;
    }
    entry.orders.assign(first.orders.end() - static_cast<std::ptrdiff_t>(common), first.orders.end());
    return entry;
}

std::vector<sequencer::MotorOrder> power_up_orders(const Machine& machine) {
    const table::Outcome* first = nullptr;
    std::size_t common = 0;
    for (const table::Outcome& outcome : machine.steps[0].outcomes) {
        if (outcome.next == 0) continue;
        if (first == nullptr) {
            first = &outcome;
            common = outcome.orders.size();
        }
        const std::size_t own = outcome.orders.size() - entry_of(machine, outcome.next).orders.size();
        common = std::min({common, own,
                           common_length(first->orders.begin(), first->orders.end(), outcome.orders.begin(),
                                         outcome.orders.end())});
    }
    if (first == nullptr) return {};
    return {first->orders.begin(), first->orders.begin() + static_cast<std::ptrdiff_t>(common)};
}

namespace {

/// The part of an outcome that distinguishes reactions.
StepTransition reaction_for(const Machine& machine, std::uint8_t step, const table::Outcome& outcome) {
    StepTransition reaction{.when = {}, .outcome = outcome};
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

bool is_same(const StepTransition& a, const StepTransition& b) {
    return a.outputs_shown == b.outputs_shown && a.outcome == b.outcome;
}

void add_split_by_error(const StepTransition& reaction, std::vector<StepTransition>& reactions) {
    const Truth error = truth_of_bit(kErrorBit);
    StepTransition good = reaction;
    StepTransition bad = reaction;
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

std::vector<StepTransition> reactions_of(const Machine& machine, std::uint8_t step) {
    const table::Step& behaviour = machine.steps[step];
    std::vector<StepTransition> merged;
    std::vector<std::size_t> index_of;  // by outcome
    for (const table::Outcome& outcome : behaviour.outcomes) {
        const StepTransition reaction = reaction_for(machine, step, outcome);
        const auto found = std::find_if(merged.begin(), merged.end(),
                                        [&](const StepTransition& r) { return is_same(r, reaction); });
        index_of.push_back(static_cast<std::size_t>(found - merged.begin()));
        if (found == merged.end()) merged.push_back(reaction);
    }
    for (std::size_t c = 0; c < kCases; ++c) merged[index_of[behaviour.of_case[c]]].when.set(c);
    std::vector<StepTransition> reactions;
    for (const StepTransition& reaction : merged) {
        const bool idle = reaction.outcome.next == step && reaction.outcome.is_quiet();
        if (!idle) add_split_by_error(reaction, reactions);
    }
    return reactions;
}

}  // namespace nplc::seqc
