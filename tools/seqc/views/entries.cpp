#include <algorithm>

#include "views/machine.h"

namespace nplc::seqc {
namespace {

/// In which cases a staying step writes one output on, writes it off, or keeps it.
struct Writes {
    Truth on;
    Truth off;
    Truth kept;
    Truth leaves;
};

Writes writes_of(const StepBehaviour& behaviour, std::uint8_t bit) {
    Writes writes;
    for (std::size_t c = 0; c < kCases; ++c) {
        const Outcome& outcome = behaviour.in(c);
        if (outcome.next != behaviour.step) {
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

/// A way into a step.
struct Way {
    std::uint8_t from = 0;
    const Outcome* outcome = nullptr;
};

std::vector<Way> ways_into(const Machine& machine, std::uint8_t step) {
    std::vector<Way> ways;
    for (std::uint8_t from = 0; from < kStepNumbers; ++from) {
        if (from == step) continue;
        for (const Outcome& outcome : machine.steps[from].outcomes) {
            if (outcome.next == step) ways.push_back({from, &outcome});
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
    if (step == 0) return {};  // a power-up sends nothing by itself
    const std::vector<Way> ways = ways_into(machine, step);
    const bool from_others =
        std::any_of(ways.begin(), ways.end(), [](const Way& way) { return way.from != 0; });
    if (ways.size() < 2 || !from_others) return {};
    const Outcome& first = *ways.front().outcome;
    std::size_t common = first.orders.size();
    Entry entry{.orders = {}, .timer = first.timer, .counter_preset = first.counter_preset};
    for (const Way& way : ways) {
        const Outcome& outcome = *way.outcome;
        common = std::min(common, common_length(first.orders.rbegin(), first.orders.rend(),
                                                outcome.orders.rbegin(), outcome.orders.rend()));
        if (outcome.timer != entry.timer) entry.timer = 0;
        if (outcome.counter_preset != entry.counter_preset) entry.counter_preset = 0;
    }
    entry.orders.assign(first.orders.end() - static_cast<std::ptrdiff_t>(common), first.orders.end());
    return entry;
}

std::vector<sequencer::MotorOrder> power_up_orders(const Machine& machine) {
    const Outcome* first = nullptr;
    std::size_t common = 0;
    for (const Outcome& outcome : machine.steps[0].outcomes) {
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

}  // namespace nplc::seqc
