// Waits for a counter that nothing counts down on any way to them.
#include <fmt/format.h>

#include <array>
#include <map>
#include <vector>

#include "compiler/checker.h"

namespace nplc::seqc {
namespace {

/// What the counter may be where a step begins a scan.
struct Count {
    bool zero = false;
    bool runs = false;
    const Action* preset = nullptr;  ///< one that it may run from

    Truth cases() const {
        const Truth at_zero = truth_of_bit(kCounterZero);
        return (zero ? at_zero : Truth()) | (runs ? ~at_zero : Truth());
    }
    bool join(const Count& other) {
        const bool is_new = (other.zero && !zero) || (other.runs && !runs);
        zero = zero || other.zero;
        runs = runs || other.runs;
        if (preset == nullptr) preset = other.preset;
        return is_new;
    }
};

/// The counter behind a rule that is taken with `before`.
Count behind(const Count& before, const Rule& rule) {
    const Truth at_zero = truth_of_bit(kCounterZero);
    const Action& action = rule.action;
    Count after = before;
    after.zero = before.zero && (rule.when & at_zero).any();
    after.runs = before.runs && (rule.when & ~at_zero).any();
    if (action.clears_counter) return {.zero = true};
    if (action.counter && *action.counter == 0) return {.zero = true};
    if (action.counter) return {.runs = true, .preset = &action};
    if (action.counts_down) after.zero = true;
    return after;
}

/// Needs the counter at 0.
bool waits_for_zero(const Truth& when) {
    return when.any() && (when & ~truth_of_bit(kCounterZero)).none();
}

class Counts {
  public:
    Counts(const Plan& plan, Report& report) : plan_(plan), report_(report) {}

    void run() {
        counts_[0] = {.zero = true};
        for (bool changed = true; changed;) {
            changed = false;
            for (const StepPlan& step : plan_.steps) {
                // A scan without a true rule keeps step and counter.
                for (const Rule& rule : step.rules) {
                    const Count& before = counts_.at(step.number);
                    if ((rule.when & before.cases()).none()) continue;
                    Count& next = counts_.at(rule.action.next.value_or(step.number));
                    changed = next.join(behind(before, rule)) || changed;
                }
            }
        }
        for (const StepPlan& step : plan_.steps) {
            for (const Rule& rule : step.rules) judge(step, rule);
        }
        for (const auto& [offset, wait] : waits_) tell(wait);
    }

  private:
    struct Wait {
        Span condition;
        bool may_end = false;
        const Action* preset = nullptr;
    };

    /// Copies of a step share their conditions: reported if no copy goes on.
    void judge(const StepPlan& step, const Rule& rule) {
        const Count& count = counts_.at(step.number);
        if (step.is_helper || (!count.zero && !count.runs)) return;
        const auto note = [&](const Truth& when, Span condition) {
            if (condition.length == 0) return;
            Wait& wait = waits_[condition.offset];
            wait.condition = condition;
            wait.may_end = wait.may_end || !waits_for_zero(when) || count.zero;
            if (wait.preset == nullptr) wait.preset = count.preset;
        };
        if (rule.parts.empty()) note(rule.when, rule.condition);
        for (const RulePart& part : rule.parts) note(part.when, part.condition);
    }

    void tell(const Wait& wait) {
        if (wait.may_end || wait.preset == nullptr) return;
        report_
            .add("W020", wait.condition, "COUNTER.Q never comes: nothing counts down on the way here",
                 "write COUNT_DOWN; where a piece is done, in a branch with NEXT or in an ENTRY")
            .notes.push_back({wait.preset->counter_span, "the counter is preset here"});
    }

    const Plan& plan_;
    Report& report_;
    std::array<Count, sequencer::kLastStep + 1U> counts_{};
    std::map<std::uint32_t, Wait> waits_;  ///< by where the condition begins
};

}  // namespace

void check_endless_counts(const Plan& plan, Report& report) {
    Counts(plan, report).run();
}

}  // namespace nplc::seqc
