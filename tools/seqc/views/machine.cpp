#include "views/machine.h"

#include <algorithm>

namespace nplc::seqc {
namespace {

using sequencer::TermView;

std::vector<TermView> terms_of(std::span<const std::uint8_t> table) {
    std::vector<TermView> terms;
    for (std::size_t at = 0; at + sequencer::kTermBytes <= table.size(); at += sequencer::kTermBytes) {
        const TermView term = table.subspan(at).first<sequencer::kTermBytes>();
        if (sequencer::is_end(term)) break;
        terms.push_back(term);
    }
    return terms;
}

KnownOutputs after(const Outcome& outcome, const KnownOutputs& before) {
    return outcome.outputs ? KnownOutputs{kAllOutputs, *outcome.outputs} : before;
}

KnownOutputs joined(const KnownOutputs& a, const KnownOutputs& b) {
    const auto known = static_cast<std::uint8_t>(a.known & b.known & ~(a.value ^ b.value));
    return {known, static_cast<std::uint8_t>(a.value & known)};
}

/// Follows all ways from power-up until nothing new is learnt.
class Walk {
  public:
    explicit Walk(Machine& machine) : machine_(machine) {
        arrive(0, {kAllOutputs, 0}, machine_.entered_with, machine_.reachable);
        arrive(0, {kAllOutputs, 0}, machine_.held, held_);
        while (!open_.empty()) {
            const std::uint8_t step = open_.back();
            open_.pop_back();
            for (const Outcome& outcome : machine_.steps[step].outcomes) follow(step, outcome);
        }
    }

  private:
    void follow(std::uint8_t step, const Outcome& outcome) {
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
    const std::vector<TermView> terms = terms_of(table);
    Machine machine;
    machine.terms = terms.size();
    machine.used.set(0);
    for (std::uint8_t step = 0; step < kStepNumbers; ++step) {
        machine.steps[step] = behaviour_of(step, terms);
        if (machine.steps[step].terms == 0) continue;
        machine.used.set(step);
        for (const Outcome& outcome : machine.steps[step].outcomes) machine.used.set(outcome.next);
    }
    Walk walk(machine);
    return machine;
}

}  // namespace nplc::seqc
