#include "report/decompile/draft.h"

#include <algorithm>
#include <utility>

#include "symbols/commands.h"

namespace nplc::seqc {
namespace {

using sequencer::TermBytes;

constexpr std::ptrdiff_t kEnoughForOnError = 2;  // steps
const Action kNoAction{};

/// The step that a term switches to.
std::optional<std::uint8_t> switches_to(const sequencer::Term& term) {
    const bool switches = !term.is_flex && term.fast.next_step < sequencer::kLastStep;
    return switches ? std::optional(term.fast.next_step) : std::nullopt;
}

/// The common end of all of the actions.
Action common_tail(const std::vector<const Action*>& actions) {
    Action tail = *actions.front();
    tail.next.reset();
    for (const Action* action : actions) {
        const auto same = std::mismatch(tail.sends.rbegin(), tail.sends.rend(), action->sends.rbegin(),
                                        action->sends.rend(),
                                        [](const Send& a, const Send& b) { return a.same_effect(b); });
        tail.sends.erase(tail.sends.begin(), same.first.base());
        if (tail.timer != action->timer) tail.timer.reset();
        if (tail.counter != action->counter) tail.counter.reset();
        tail.clears_counter = tail.clears_counter && action->clears_counter;
        tail.counts_down = tail.counts_down && action->counts_down;
    }
    return tail;
}

bool starts_a_move(const Send& send) {
    const auto select = send.reg == nullptr ? select_command(send.command) : std::nullopt;
    return select && select->mode != table::Mode::init;
}

Action moves_at_the_end(const Action& action) {
    Action moves;
    const auto first = std::find_if_not(action.sends.rbegin(), action.sends.rend(), starts_a_move).base();
    moves.sends.assign(first, action.sends.end());
    return moves;
}

}  // namespace

Drafter::Drafter(const Layout& layout, registers::Model motor) : layout_(layout) {
    for (const Part& part : layout.steps) groups_.push_back(groups_of(part.terms, motor));
}

/// OUT of a step: the outputs written by most terms that enter it; if there are none, those that all its own
/// terms write.
std::vector<std::uint8_t> Drafter::voted_outputs() const {
    constexpr std::size_t kSteps = 64;
    std::array<std::array<std::size_t, 16>, kSteps> votes{};
    std::array<int, kSteps> own{};
    own.fill(-1);
    const auto count = [&](const Terms& terms) {
        for (const TermBytes& bytes : terms) {
            const sequencer::Term term = sequencer::decode(bytes);
            if (term.is_flex) continue;
            const std::uint8_t from = term.condition.step;
            const std::size_t to = switches_to(term).value_or(from);
            const std::uint8_t outputs = term.fast.outputs;
            if (to != from) {
                ++votes[to][outputs];
            } else {
                own[from] = own[from] < 0 ? outputs : own[from] & outputs;
            }
        }
    };
    for (const Part& part : layout_.steps) count(part.terms);
    count(layout_.outside);
    std::vector<std::uint8_t> outputs(sequencer::kLastStep + 1U);
    for (std::size_t step = 0; step < outputs.size(); ++step) {
        const auto most = std::max_element(votes[step].begin(), votes[step].end());
        const bool entered = *most != 0;
        outputs[step] =
            static_cast<std::uint8_t>(entered ? most - votes[step].begin() : std::max(own[step], 0));
    }
    return outputs;
}

/// The most common action on ERROR. Step 0 is not counted: POWER_UP writes its values there as well.
std::optional<Action> Drafter::voted_fault(const Surroundings& around) const {
    std::vector<std::pair<const Action*, std::ptrdiff_t>> votes;
    for (std::size_t i = 0; i < layout_.steps.size(); ++i) {
        if (layout_.steps[i].number == 0) continue;
        const Action* exit = error_exit(layout_.steps[i], groups_[i], around);
        if (exit == nullptr) continue;
        const auto same = std::find_if(votes.begin(), votes.end(),
                                       [&](const auto& vote) { return vote.first->same_effect(*exit); });
        if (same == votes.end()) {
            votes.emplace_back(exit, 1);
        } else {
            ++same->second;
        }
    }
    const auto most = std::max_element(votes.begin(), votes.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most == votes.end() || most->second < kEnoughForOnError) return std::nullopt;
    return *most->first;
}

Draft Drafter::draft(const Exclusions& exclusions) {
    Draft draft;
    draft.around.outputs = voted_outputs();
    if (!exclusions.on_error) draft.around.fault = voted_fault(draft.around);
    find_shapes(exclusions, draft);
    const auto users =
        std::count_if(draft.shapes.begin(), draft.shapes.end(),
                      [](const std::optional<Shape>& shape) { return shape && !shape->plan.own_error; });
    if (draft.around.fault && users < kEnoughForOnError) {
        Exclusions more = exclusions;
        more.on_error = true;
        return this->draft(more);
    }
    find_entries(exclusions, draft);
    take_entry_from_values(draft);
    note_outputs(draft);
    return draft;
}

const std::optional<Shape>& Drafter::shape_of(std::size_t index, const Surroundings& around) {
    const auto key = std::tuple(index, around.fault.has_value(), around.outputs[0]);
    const auto known = found_.find(key);
    if (known != found_.end()) return known->second;
    return found_[key] = find_shape(layout_.steps[index], groups_[index], around);
}

void Drafter::find_shapes(const Exclusions& exclusions, Draft& draft) {
    draft.shapes.assign(layout_.steps.size(), std::nullopt);
    std::size_t zero = layout_.steps.size();
    const bool zero_outside = std::any_of(layout_.outside.begin(), layout_.outside.end(),
                                          [](const TermBytes& t) { return sequencer::step_of(t) == 0; });
    for (std::size_t i = 0; i < layout_.steps.size(); ++i) {
        const Part& part = layout_.steps[i];
        if (part.number == 0) zero = i;
        if (i == 0 && part.number == 0 && !exclusions.power_up && !zero_outside) {
            draft.power_up = find_power_up(part, groups_[i], draft.around);
            if (draft.power_up) continue;
        }
        if (!exclusions.shape.test(part.number)) draft.shapes[i] = shape_of(i, draft.around);
    }
    // A step with the number 0 writes its own OUT, so it can have none if it consists of TERMs.
    const bool must_be_silent =
        zero < layout_.steps.size() && !draft.power_up && !draft.shapes[zero] && draft.around.outputs[0] != 0;
    if (!must_be_silent) return;
    draft.around.outputs[0] = 0;
    Exclusions more = exclusions;
    more.shape.set(0);
    find_shapes(more, draft);
}

std::vector<const Action*> Drafter::ways_into(std::uint8_t step, const Draft& draft) const {
    std::vector<const Action*> ways;
    if (draft.power_up && draft.power_up->action.next == step)
        ways.push_back(draft.around.fault ? &draft.power_up->commands : &draft.power_up->action);
    // A TERM states all of its effects.
    const auto add_terms = [&](const Terms& terms, std::size_t first) {
        for (std::size_t i = first; i < terms.size(); ++i) {
            if (switches_to(sequencer::decode(terms[i])) == step) ways.push_back(&kNoAction);
        }
    };
    for (std::size_t i = 0; i < layout_.steps.size(); ++i) {
        const std::optional<Shape>& shape = draft.shapes[i];
        if (shape) {
            for (const Rule& rule : shape->plan.rules) {
                if (rule.action.next == step) ways.push_back(&rule.action);
            }
            if (!shape->plan.own_error && draft.around.fault->next == step)
                ways.push_back(&*draft.around.fault);
        }
        const bool is_power_up = i == 0 && draft.power_up;
        if (!is_power_up) add_terms(layout_.steps[i].terms, shape ? shape->terms : 0);
    }
    add_terms(layout_.outside, 0);
    return ways;
}

/// ENTRY: the common end of all transitions into a step; for a single transition only the move, since the
/// step is about it. ENTRY of the fault step is the action of ON ERROR.
void Drafter::find_entries(const Exclusions& exclusions, Draft& draft) const {
    for (std::size_t i = 0; i < layout_.steps.size(); ++i) {
        const std::uint8_t step = layout_.steps[i].number;
        if (exclusions.entry.test(step) || (step == 0 && draft.power_up)) continue;
        if (draft.around.fault && draft.around.fault->next == step) {
            draft.entries[step] = *draft.around.fault;
            draft.entries[step].next.reset();
            continue;
        }
        const bool stays = draft.shapes[i] &&
                           std::any_of(draft.shapes[i]->plan.rules.begin(), draft.shapes[i]->plan.rules.end(),
                                       [&](const Rule& r) { return r.action.next == step; });
        const std::vector<const Action*> ways = ways_into(step, draft);
        if (stays || ways.empty()) continue;
        draft.entries[step] = ways.size() > 1 ? common_tail(ways) : moves_at_the_end(*ways.front());
    }
}

/// Without ON ERROR, POWER_UP's writes need not be values; those of ENTRY are not.
void Drafter::take_entry_from_values(Draft& draft) const {
    if (!draft.power_up || draft.around.fault) return;
    PowerUp& power_up = *draft.power_up;
    const std::size_t entry = draft.entries[*power_up.action.next].sends.size();
    power_up.values = std::min(power_up.values, power_up.action.sends.size() - entry);
}

/// OUT is not written if terms disagree about it and no branch uses it.
void Drafter::note_outputs(Draft& draft) const {
    const auto agree = [&](const Terms& terms, std::uint8_t step) {
        return std::all_of(terms.begin(), terms.end(), [&](const TermBytes& bytes) {
            const sequencer::Term term = sequencer::decode(bytes);
            return switches_to(term) != step || term.fast.outputs == draft.around.outputs[step];
        });
    };
    for (std::size_t i = 0; i < layout_.steps.size(); ++i) {
        const std::uint8_t step = layout_.steps[i].number;
        bool says = draft.shapes[i].has_value() || draft.around.outputs[step] != 0;
        if (says && !draft.shapes[i]) {
            bool entered = draft.power_up && draft.power_up->action.next == step;
            for (const std::optional<Shape>& shape : draft.shapes) {
                if (!shape) continue;
                entered = entered || (!shape->plan.own_error && draft.around.fault->next == step) ||
                          std::any_of(shape->plan.rules.begin(), shape->plan.rules.end(),
                                      [&](const Rule& rule) { return rule.action.next == step; });
            }
            says = entered || (agree(layout_.outside, step) &&
                               std::all_of(layout_.steps.begin(), layout_.steps.end(),
                                           [&](const Part& part) { return agree(part.terms, step); }));
        }
        draft.says_outputs[step] = says;
    }
}

}  // namespace nplc::seqc
