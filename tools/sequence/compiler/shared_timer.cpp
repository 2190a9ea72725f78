#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/copies.h"
#include "language/names.h"

namespace nplc::seqc {
namespace {

/// For each step that is entered with a timer that a WITHIN, FOR or BLINKING has changed: which one.
std::map<std::uint8_t, Span> entered_changed(const Plan& plan) {
    std::map<std::uint8_t, Span> changed;
    const auto note = [&](const StepPlan& from, Span by) {
        bool is_new = false;
        for_each_rule(from, [&](const Rule& rule) {
            if (!leaves(from, rule) || rule.action.timer) return;
            is_new = changed.emplace(*rule.action.next, by).second || is_new;
        });
        return is_new;
    };
    for (bool again = true; again;) {
        again = false;
        for (const StepPlan& step : plan.steps) {
            if (step.memory.timer_span) {
                again = note(step, *step.memory.timer_span) || again;
            } else if (const auto by = changed.find(step.number); by != changed.end()) {
                again = note(step, by->second) || again;
            }
        }
    }
    return changed;
}

/// The same test of the timer, in all calls of its SEQUENCE.
struct Test {
    Span condition;
    std::string_view name;  ///< of the step, in the first of these calls
    const ast::Origin* origin = nullptr;
    std::vector<Span> used;  ///< where the timer was changed before
    std::vector<Span> calls;
};

void tell(const Test& test, const SequenceCalls& calls, Report& report) {
    Diagnostic& d = report.add("E073", test.condition,
                               fmt::format("{} is entered with a timer that another step has used for itself",
                                           calls.shown(test.name)),
                               fmt::format("preset it on the way: TIMER := T#500ms; NEXT := {};",
                                           test.origin == nullptr ? test.name : test.origin->step));
    for (const Span used : test.used) d.notes.push_back({used, "it is used here"});
    if (test.calls.empty()) return;
    const Span first = *std::min_element(test.calls.begin(), test.calls.end(),
                                         [](Span a, Span b) { return a.offset < b.offset; });
    d.notes.push_back({first, calls.lines(test.calls)});
}

}  // namespace

void check_shared_timer(const Plan& plan, const SequenceCalls& calls, Report& report) {
    const std::map<std::uint8_t, Span> changed = entered_changed(plan);
    std::vector<Test> tests;
    for (const StepPlan& step : plan.steps) {
        const auto by = changed.find(step.number);
        if (by == changed.end() || step.memory.timer_span) continue;
        const auto rule = std::find_if(step.rules.begin(), step.rules.end(), [](const Rule& r) {
            return depends_on(r.when, kTimerZero) && r.condition.length != 0;
        });
        if (rule == step.rules.end()) continue;
        const ast::Origin* origin = calls.origin_of(step.name);
        auto test = std::find_if(tests.begin(), tests.end(), [&](const Test& known) {
            return origin != nullptr && known.origin != nullptr && known.condition == rule->condition &&
                   same_name(known.origin->step, origin->step) &&
                   known.origin->sequence.span == origin->sequence.span;
        });
        if (test == tests.end()) {
            tests.push_back({rule->condition, step.name, origin, {}, {}});
            test = std::prev(tests.end());
        }
        if (std::find(test->used.begin(), test->used.end(), by->second) == test->used.end())
            test->used.push_back(by->second);
        if (origin != nullptr)
            test->calls.insert(test->calls.end(), origin->calls.begin(), origin->calls.end());
    }
    for (const Test& test : tests) tell(test, calls, report);
}

}  // namespace nplc::seqc
