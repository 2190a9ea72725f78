// Advice about valid but rarely intended code: a step may ALLOW it with a reason.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "compiler/checker.h"
#include "compiler/guards.h"
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
    Arrivals(const ast::Program& program, const Plan& plan, Report& report)
        : program_(program), plan_(plan), report_(report) {
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
                if (rule.action.next && leaves(step, rule)) note_entry(*rule.action.next, rule);
            }
        }
    }

    void run() {
        for (const StepPlan& step : plan_.steps) {
            if (!moving_.contains(step.number)) continue;
            for (const Rule& rule : step.rules) judge(step, rule);
            judge_timed(step);
        }
    }

  private:
    /// Whether each way into a step sends the motor to a place.
    void note_entry(std::uint8_t step, const Rule& rule) {
        const Send* last = nullptr;
        for (const Send& send : rule.action.sends) {
            if (moves(motion_effect_of(send)) || motion_effect_of(send) == MotionEffect::stop) last = &send;
        }
        const bool to_place = last != nullptr && motion_effect_of(*last) == MotionEffect::place;
        const auto [found, is_new] = sent_.try_emplace(step, to_place ? last : nullptr);
        if (!is_new && !to_place) found->second = nullptr;
    }

    static bool tests_arrival(const StepPlan& step) {
        return std::any_of(step.rules.begin(), step.rules.end(),
                           [](const Rule& rule) { return depends_on(rule.when, kInPosBit); });
    }

    static bool sets_motion(const Rule& rule) {
        return std::any_of(rule.action.sends.begin(), rule.action.sends.end(),
                           [](const Send& send) { return motion_effect_of(send) != MotionEffect::none; });
    }

    /// Something is switched on or counted where the axis should have arrived.
    static bool acts(const StepPlan& from, const Rule& rule, const StepPlan& to) {
        unsigned on = to.outputs;
        for (const ConditionalOutput& output : to.conditional) on |= output.outputs;
        return (on & ~unsigned{from.outputs}) != 0 || rule.action.sets != 0 || rule.action.counts();
    }

    /// A move that is left by the timer alone, to a step that acts. Guards, and ways into the fault step, do
    /// not count.
    void judge_timed(const StepPlan& step) {
        const auto sent = sent_.find(step.number);
        if (sent == sent_.end() || sent->second == nullptr || step.is_helper || tests_arrival(step)) return;
        Truth ordinary = ~truth_of_bit(kErrorBit);
        const Rule* by_timer = nullptr;
        for (const Rule& rule : step.rules) {
            if (!leaves(step, rule) || needs_error(rule.when)) continue;
            if (fault_.contains(*rule.action.next) || is_guard(program_, rule.condition)) {
                ordinary &= ~rule.when;
            } else if (by_timer != nullptr) {
                return;
            } else {
                by_timer = &rule;
            }
        }
        if (by_timer == nullptr || (by_timer->when & ordinary) != (truth_of_bit(kTimerZero) & ordinary))
            return;
        const StepPlan* to = step_numbered(plan_, *by_timer->action.next);
        if (to == nullptr || tests_arrival(*to) || sets_motion(*by_timer) || !acts(step, *by_timer, *to))
            return;
        if (by_timer->condition.length == 0 || !said_.insert(by_timer->condition.offset).second) return;
        report_
            .add("W038", by_timer->condition,
                 "the end of a time is taken for an arrival here: the motor may not be where it was sent",
                 "write IF INPOS WITHIN T#5s THEN .. ELSE NEXT := Fault; END_IF, or ALLOW W038 BECAUSE "
                 "'reason'; "
                 "in the step")
            .notes.push_back({sent->second->span, "the move begins here"});
    }

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

    const ast::Program& program_;
    const Plan& plan_;
    Report& report_;
    std::map<std::uint8_t, const Send*> sent_;  ///< by step: its move to a place, nullptr if not each way
                                                ///< into it has one
    std::set<std::uint32_t> limited_;           ///< conditions with WITHIN
    std::set<std::uint8_t> fault_;
    std::set<std::uint8_t> moving_;
    std::set<std::uint32_t> said_;
};

}  // namespace

void check_arrivals(const ast::Program& program, const Plan& plan, Report& report) {
    Arrivals(program, plan, report).run();
}

}  // namespace nplc::seqc
