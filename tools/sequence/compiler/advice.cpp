// Advice about valid but rarely intended code: a step may ALLOW it with a reason.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "compiler/checker.h"
#include "compiler/orders.h"

namespace nplc::seqc {
namespace {

/// IF INPOS OR TIMER.Q: whether the motor arrived is not asked.
bool takes_limit_for_arrival(const Truth& when) {
    for (std::size_t at = 0; at < kCases; ++at) {
        const auto bit = [](std::size_t number) { return std::size_t{1} << number; };
        const bool is_plain = (at & (bit(kInPosBit) | bit(kErrorBit) | bit(kTimerZero))) == 0;
        if (is_plain && !when.test(at) && when.test(at | bit(kInPosBit)) && when.test(at | bit(kTimerZero)))
            return true;
    }
    return false;
}

class Arrivals {
  public:
    Arrivals(const ast::Program& program, const Plan& plan, Report& report) : plan_(plan), report_(report) {
        for (const ast::Step& step : program.steps) {
            for (const ast::Choice& choice : step.choices) {
                const ast::Branch& first = choice.branches.front();
                if (first.condition && first.timing && first.timing->is_limit)
                    limited_.insert(first.condition->span.offset);
            }
        }
        for (const StepPlan& step : plan.steps) {
            for (const Rule& rule : step.rules) {
                const bool on_error = !step.own_error && (rule.when & ~truth_of_bit(kErrorBit)).none();
                if (on_error && rule.action.next) fault_.insert(*rule.action.next);
                if (rule.action.next && motion_of(rule) != nullptr) moving_.insert(*rule.action.next);
            }
        }
    }

    void run() {
        for (const StepPlan& step : plan_.steps) {
            if (!moving_.contains(step.number)) continue;
            for (const Rule& rule : step.rules) judge(step, rule);
        }
    }

  private:
    void judge(const StepPlan& step, const Rule& rule) {
        if (leaves(step, rule)) {
            for (const RulePart& part : rule.parts)
                judge_turned(part.when, part.condition, *rule.action.next);
        }
        if (!leaves(step, rule) || fault_.contains(*rule.action.next) || rule.condition.length == 0) return;
        for (const RulePart& part : rule.parts) judge_part(part.when, part.condition);
        if (rule.parts.empty()) judge_part(rule.when, rule.condition);
        // IF INPOS THEN NEXT := Grip; ELSIF TIMER.Q THEN NEXT := Grip;
        for (const RulePart& part : rule.parts) {
            if (depends_on(part.when, kTimerZero)) judge_part(rule.when, part.condition);
        }
    }

    void judge_part(const Truth& when, Span condition) {
        if (condition.length == 0 || !takes_limit_for_arrival(when) || !said_.insert(condition.offset).second)
            return;
        report_.add(
            "W038", condition,
            "a time limit is taken for an arrival here: the motor may not be where it was sent",
            "write IF INPOS THEN .. ELSIF TIMER.Q THEN NEXT := Fault; or ALLOW W038 BECAUSE 'reason'; in "
            "the step");
    }

    /// IF NOT INPOS WITHIN .., or the fault step in the branch of INPOS.
    void judge_turned(const Truth& when, Span condition, std::uint8_t next) {
        if (condition.length == 0 || !limited_.contains(condition.offset)) return;
        const bool by_arrival = fault_.contains(next) && (when & ~truth_of_bit(kInPosBit)).none();
        const bool before_arrival = depends_on(when, kInPosBit) && (when & truth_of_bit(kInPosBit)).none();
        if ((!by_arrival && !before_arrival) || !said_.insert(condition.offset).second) return;
        report_.add("W045", condition,
                    by_arrival
                        ? "the arrival leads to the fault step, and the end of the time limit goes on: "
                          "are the branches exchanged?"
                        : "this holds at once, for a move that was just ordered has not arrived: its end "
                          "is not waited for",
                    "write IF INPOS WITHIN .. THEN what follows the move ELSE NEXT := Fault; or ALLOW W045 "
                    "BECAUSE 'reason'; in the step");
    }

    const Plan& plan_;
    Report& report_;
    std::set<std::uint32_t> limited_;  ///< conditions with WITHIN
    std::set<std::uint8_t> fault_;
    std::set<std::uint8_t> moving_;
    std::set<std::uint32_t> said_;
};

}  // namespace

void check_arrivals(const ast::Program& program, const Plan& plan, Report& report) {
    Arrivals(program, plan, report).run();
}

}  // namespace nplc::seqc
