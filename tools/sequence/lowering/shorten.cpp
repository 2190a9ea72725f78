#include "lowering/shorten.h"

#include "lowering/effects.h"
#include "lowering/label_search.h"
#include "lowering/least_list.h"
#include "lowering/order_plan.h"

namespace nplc::seqc {
namespace {

using sequencer::Condition;
using sequencer::Term;

/// Maps the bits of a reduced case to those of truth.h.
std::size_t spread(std::size_t reduced, const ReducedStep& error_branch, std::size_t first,
                   std::size_t last) {
    std::size_t result = 0;
    for (std::size_t i = first; i < last; ++i)
        result |= ((reduced >> (i - first)) & 1U) << error_branch.bits[i];
    return result;
}

Condition condition_of(const Region& region, const ReducedStep& error_branch) {
    const std::size_t zeros =
        spread(region.zeros, error_branch, error_branch.inputs, error_branch.bits.size());
    const std::size_t value = spread(region.value, error_branch, 0, error_branch.inputs);
    return {
        .step = error_branch.step->number,
        .needs_counter_zero = (zeros >> kCounterZero & 1U) != 0,
        .needs_timer_zero = (zeros >> kTimerZero & 1U) != 0,
        .input = static_cast<sequencer::InputImage>(value | (error_branch.error ? sequencer::kError : 0)),
        .care = static_cast<std::uint8_t>(spread(region.care, error_branch, 0, error_branch.inputs)),
    };
}

/// Source position of the behaviour of the first case in the region.
Span span_of(const PlacedTerm& placed, const ReducedStep& error_branch) {
    if (placed.order != nullptr) return placed.order->send->span;
    for (std::size_t c = 0; c < error_branch.cases(); ++c) {
        const Behaviour& wanted = error_branch.at(c);
        if (!placed.region.holds(c, error_branch.inputs) || wanted.action == nullptr) continue;
        if (wanted.next == placed.next && wanted.output_byte() == placed.output_byte)
            return wanted.action->span;
    }
    return error_branch.step->span;
}

LoweredTerm lowered(const PlacedTerm& placed, const ReducedStep& error_branch) {
    Term term;
    term.condition = condition_of(placed.region, error_branch);
    if (placed.order != nullptr && !placed.order->is_fast()) {
        term.is_flex = true;
        term.flex = write_of(*placed.order->send);
        return {sequencer::encode(term), span_of(placed, error_branch)};
    }
    term.fast.next_step = placed.names_next ? placed.next : sequencer::kNoSwitch;
    term.fast.outputs = placed.output_byte & 0x0F;
    term.fast.clears_counter = (placed.output_byte & 0x40) != 0;
    term.fast.counts_down = (placed.output_byte & 0x80) != 0;
    term.fast.presets_counter = placed.preset == Preset::counter;
    term.fast.preset = placed.value;
    term.fast.sends = placed.order != nullptr;
    if (placed.order != nullptr) term.fast.command = placed.order->send->command;
    return {sequencer::encode(term), span_of(placed, error_branch)};
}

/// The common behaviour of all cases that do not stay, if it is one step change without orders and presets.
const Behaviour* only_switch(const ReducedStep& error_branch) {
    const Behaviour* only = nullptr;
    for (const Behaviour& behaviour : error_branch.behaviours) {
        if (behaviour.action == nullptr && !behaviour.writes) continue;
        const bool is_switch = behaviour.action != nullptr && behaviour.leaves && behaviour.sends() == 0 &&
                               !behaviour.action->presets();
        if (!is_switch || only != nullptr) return nullptr;
        only = &behaviour;
    }
    return only;
}

/// The terms of a reduced step that is one step change over few variables; empty if there are none of fewer.
std::vector<LoweredTerm> least_switch(const ReducedStep& error_branch, std::size_t fewer_than) {
    const Behaviour* wanted = only_switch(error_branch);
    if (wanted == nullptr || error_branch.bits.size() > Ternary::kMostSmall) return {};
    SmallSet set = 0;
    for (std::size_t c = 0; c < error_branch.cases(); ++c)
        set |= &error_branch.at(c) == wanted ? SmallSet{1} << c : 0;
    const Ternary& cubes =
        Ternary::of(error_branch.bits.size(), error_branch.bits.size() - error_branch.inputs);
    std::vector<LoweredTerm> terms;
    for (const ListedCube& listed : least_list(set, cubes, fewer_than)) {
        const std::size_t inputs = (std::size_t{1} << error_branch.inputs) - 1;
        PlacedTerm term;
        term.region = {static_cast<std::uint8_t>(listed.cube.value & inputs),
                       static_cast<std::uint8_t>(listed.cube.care & inputs),
                       static_cast<std::uint8_t>(listed.cube.value >> error_branch.inputs)};
        term.next = listed.in ? wanted->next : error_branch.step->number;
        term.output_byte = listed.in ? wanted->output_byte() : error_branch.step->outputs;
        terms.push_back(lowered(term, error_branch));
    }
    return terms;
}

}  // namespace

std::vector<LoweredTerm> shorten(const ReducedStep& error_branch, std::size_t fewer_than) {
    std::vector<LoweredTerm> best;
    if (fewer_than < 2) return best;
    for (const OrderPlan& plan : order_plans(error_branch)) {
        if (plan.size() >= fewer_than) break;
        LabelSearch search(error_branch, plan);
        if (plan.size() + search.fewest() >= fewer_than) continue;
        const auto found = search.run(fewer_than - 1 - plan.size());
        if (!found) continue;
        best.clear();
        for (const PlacedTerm& placed : *found) best.push_back(lowered(placed, error_branch));
        fewer_than = best.size();
    }
    const std::vector<LoweredTerm> least = least_switch(error_branch, fewer_than);
    return least.empty() ? best : least;
}

}  // namespace nplc::seqc
