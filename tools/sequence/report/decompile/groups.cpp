#include "report/decompile/groups.h"

#include <algorithm>
#include <span>

#include "lowering/effects.h"
#include "report/decompile/vocabulary.h"
#include "table/step.h"

namespace nplc::seqc {
namespace {

using sequencer::FastStatement;
using sequencer::Term;
using sequencer::TermBytes;

bool same_condition(const TermBytes& a, const TermBytes& b) {
    return sequencer::decode(a).condition == sequencer::decode(b).condition;
}

void add_fast(const FastStatement& fast, Group& group) {
    Action& action = group.action;
    if (fast.next_step != sequencer::kNoSwitch) action.next = fast.next_step;
    group.outputs = fast.outputs;
    group.writes_outputs = true;
    action.clears_counter = fast.clears_counter;
    action.counts_down = fast.counts_down;
    if (fast.preset != 0) (fast.presets_counter ? action.counter : action.timer) = fast.preset;
}

/// The terms as one action, if the compiler would generate exactly these from it.
Group group_of(std::span<const TermBytes> terms, registers::Model model) {
    Group group;
    group.count = terms.size();
    group.when = table::cases_of(terms.front());
    for (const TermBytes& bytes : terms) {
        const Term term = sequencer::decode(bytes);
        if (sequencer::has_order(bytes)) group.action.sends.push_back(send_of(bytes, model));
        if (!term.is_flex) add_fast(term.fast, group);
    }
    Effect effect;
    effect.action = &group.action;
    effect.outputs = group.outputs;
    effect.writes_outputs = group.writes_outputs;
    std::vector<LoweredTerm> made;
    append_terms(effect, sequencer::decode(terms.front()).condition, made);
    group.sound = std::equal(made.begin(), made.end(), terms.begin(), terms.end(),
                             [](const LoweredTerm& a, const TermBytes& b) { return a.bytes == b; });
    return group;
}

}  // namespace

std::vector<Group> groups_of(const Terms& terms, registers::Model model) {
    std::vector<Group> groups;
    std::size_t at = 0;
    while (at < terms.size()) {
        Group group;
        group.count = 1;
        group.when = table::cases_of(terms[at]);
        // The compiler's terms for the beginning of an action are the beginning of its terms.
        for (std::size_t count = 1; at + count <= terms.size(); ++count) {
            const TermBytes& last = terms[at + count - 1];
            if (!same_condition(terms[at], last) || !obstacle(last, model).empty()) break;
            Group longer = group_of(std::span(terms).subspan(at, count), model);
            if (!longer.sound) break;
            group = std::move(longer);
        }
        group.first = at;
        at += group.count;
        groups.push_back(std::move(group));
    }
    return groups;
}

}  // namespace nplc::seqc
