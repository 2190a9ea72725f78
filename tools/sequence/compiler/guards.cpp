// Steps that are entered while the motor moves, and that do not stop it.
#include "compiler/guards.h"

#include <fmt/format.h>

#include <array>
#include <set>
#include <utility>
#include <vector>

#include "compiler/checker.h"
#include "compiler/orders.h"
#include "compiler/step_walk.h"

namespace nplc::seqc {
namespace {

constexpr std::uint32_t kVelocityMode = 1;  ///< of MODE_REG

/// The motions that may be under way, by the orders that began them; length 0: none.
struct MotionState {
    bool known = false;
    bool may_stand = false;
    bool may_follow = false;  ///< a gear, which stands while its master does
    Span run;
    Span place;
    Span drive;

    bool is_known() const { return known; }
    bool join(const MotionState& other) {
        bool news = !known || (other.may_stand && !may_stand) || (other.may_follow && !may_follow);
        known = true;
        may_stand = may_stand || other.may_stand;
        may_follow = may_follow || other.may_follow;
        const auto take = [&](Span& own, Span more) {
            if (own.length != 0 || more.length == 0) return;
            own = more;
            news = true;
        };
        take(run, other.run);
        take(place, other.place);
        take(drive, other.drive);
        return news;
    }
    void stand() {
        run = place = drive = {};
        may_stand = true;
    }
    /// INPOS is "at speed" of a run.
    void arrive() {
        place = drive = {};
        may_stand = may_stand || run.length == 0;
    }
    Span any() const { return run.length != 0 ? run : place.length != 0 ? place : drive; }
    bool surely_runs() const { return run.length != 0 && !may_stand && !may_follow; }
    bool surely_stands() const { return any().length == 0; }
};

class MotionWalk {
  public:
    using State = MotionState;

    MotionWalk(const ast::Program& program, const Plan& plan, std::optional<std::uint8_t> fault,
               Report& report)
        : program_(program), plan_(plan), report_(report) {
        if (const StepPlan* step = fault ? step_numbered(plan_, *fault) : nullptr) fault_ = step->span;
    }

    /// An ERROR stops the motor by itself (001 §3.2.35).
    void enter(MotionState& state, const StepPlan& step, const Rule& rule) {
        step_ = &step;
        before_ = state;
        if (needs_error(rule.when)) state.stand();
        if (needs_in_position(rule)) state.arrive();
    }

    static void apply(MotionState& state, const Send& send) {
        const MotionEffect effect = motion_effect_of(send);
        if (effect == MotionEffect::stop) {
            state.run = state.place = {};
            state.may_stand = true;
        }
        if (effect != MotionEffect::init && !moves(effect)) return;
        state.stand();
        state.may_stand = effect == MotionEffect::init;
        state.may_follow = send.reg != nullptr && send.value != kVelocityMode;
        if (effect == MotionEffect::run) state.run = send.span;
        if (effect == MotionEffect::place) state.place = send.span;
        if (outlasts_stop(effect)) state.drive = send.span;
    }

    void judge(const Rule& rule, MotionState after) {
        const StepPlan* to = leaves(*step_, rule) ? step_numbered(plan_, *rule.action.next) : nullptr;
        if (to == nullptr) return;
        for (const Send& send : rule.action.sends) apply(after, send);
        const StepPlan* target = behind_helper(*to);
        if (after.surely_stands()) entered_at_rest_.insert(target->span.offset);
        if (before_.any().length == 0) return;
        const bool goes_on = !is_ordered(rule) && !goes_on_with_order(*to, 3);
        if (goes_on && !step_->is_helper) {
            judge_limit(rule, *target);
            if (after.surely_runs()) note_run(rule, *target, after);
        }
        for_each_part(rule, [&](const Truth& when, Span condition) {
            if (!is_meant(when, condition, *target)) return;
            MotionState state = before_;
            if ((when & ~truth_of_bit(kInPosBit)).none()) state.arrive();
            if (state.any().length == 0 || !goes_on) return;
            warn(condition, *target, state);
        });
    }

    /// Steps that begin to move the motor as if it stood, and that a running one leads to.
    void judge_runs() {
        for (const Run& run : runs_) {
            if (!entered_at_rest_.contains(run.target->span.offset) || ends_a_run(*run.target) ||
                !said_.insert({run.place.offset, run.target->span.offset}).second)
                continue;
            report_
                .add("W048", run.place,
                     fmt::format("the motor runs on in '{}', a step that is also entered while it stands, "
                                 "and that does not stop it",
                                 run.target->name),
                     "write STOP; in front of the NEXT; or ALLOW W048 BECAUSE 'reason'; in the step")
                .notes.push_back({run.began, "it runs since here"});
        }
    }

  private:
    /// Where a motor that surely runs is led on without an order.
    struct Run {
        Span place;
        Span began;
        const StepPlan* target = nullptr;
    };

    static bool needs(const Truth& when, std::size_t bit) { return (when & ~truth_of_bit(bit)).none(); }

    static Span place_of(const Rule& rule, Span condition) {
        return condition.length != 0 ? condition : rule.action.next_span;
    }

    template <class Test>
    bool any_rule(const StepPlan& step, const Test& test) const {
        return std::any_of(plan_.steps.begin(), plan_.steps.end(), [&](const StepPlan& copy) {
            return copy.span == step.span &&
                   std::any_of(copy.rules.begin(), copy.rules.end(),
                               [&](const Rule& rule) { return leaves(copy, rule) && test(rule); });
        });
    }

    bool waits_for_arrival(const StepPlan& step) const {
        return any_rule(step, [](const Rule& rule) {
            bool waits = false;
            for_each_part(rule, [&](const Truth& when, Span) {
                waits = waits || (needs(when, kInPosBit) && !needs(when, kTimerZero));
            });
            return waits;
        });
    }

    /// In the rule, or in the helper step that it leads to.
    template <class Test>
    bool any_effect(const Rule& rule, const Test& test) const {
        const auto sends = [&](const Rule& by) {
            return std::any_of(by.action.sends.begin(), by.action.sends.end(),
                               [&](const Send& send) { return test(motion_effect_of(send)); });
        };
        const StepPlan* to = rule.action.next ? step_numbered(plan_, *rule.action.next) : nullptr;
        return sends(rule) ||
               (to != nullptr && to->is_helper && std::any_of(to->rules.begin(), to->rules.end(), sends));
    }

    /// The axis presses on for a time, and the next order comes by itself.
    bool is_a_dwell(const StepPlan& step) const {
        return any_rule(step, [&](const Rule& rule) {
            return needs(rule.when, kTimerZero) && any_effect(rule, [](MotionEffect effect) {
                       return effect == MotionEffect::init || effect == MotionEffect::stop || moves(effect);
                   });
        });
    }

    /// The arrival leads there: W038 and W045 judge that.
    bool arrives_at(Span target) const {
        return any_rule(*step_, [&](const Rule& rule) {
            const StepPlan* to = step_numbered(plan_, *rule.action.next);
            bool arrives = false;
            for_each_part(rule,
                          [&](const Truth& when, Span) { arrives = arrives || needs(when, kInPosBit); });
            return arrives && to != nullptr && behind_helper(*to)->span == target;
        });
    }

    /// The end of the time that a step gives its move.
    void judge_limit(const Rule& rule, const StepPlan& target) {
        const Span began = before_.place.length != 0 ? before_.place : before_.drive;
        if (began.length == 0 || target.span == step_->span || !waits_for_arrival(*step_) ||
            waits_for_arrival(target) || is_a_dwell(target) || arrives_at(target.span) ||
            (fault_.length != 0 && arrives_at(fault_)))
            return;
        for_each_part(rule, [&](const Truth& when, Span condition) {
            if (!needs(when, kTimerZero) || needs(when, kInPosBit) || needs_error(when) ||
                is_meant(when, condition, target))
                return;
            const Span place = place_of(rule, condition);
            if (!said_.insert({place.offset, target.span.offset}).second) return;
            const char* how = before_.drive.length != 0 ? "MODE_REG := 0;" : "STOP;";
            report_
                .add("W047", place,
                     fmt::format("the time limit of this move leads to '{}', and nothing stops the motor: it "
                                 "may move on there",
                                 target.name),
                     fmt::format("write ENTRY {} in '{}'; or ALLOW W047 BECAUSE 'reason'; in the step with "
                                 "the limit",
                                 how, target.name))
                .notes.push_back({began, "the motion that began here may continue"});
        });
    }

    void note_run(const Rule& rule, const StepPlan& target, const MotionState& state) {
        if (target.span == step_->span) return;
        for_each_part(rule, [&](const Truth& when, Span condition) {
            if (!needs_error(when) && !is_meant(when, condition, target))
                runs_.push_back({place_of(rule, condition), state.run, &target});
        });
    }

    /// The step reckons with a motor that runs.
    bool ends_a_run(const StepPlan& step) const {
        return any_rule(step, [&](const Rule& rule) {
            bool is_own = false;
            for_each_part(rule, [&](const Truth& when, Span condition) {
                is_own = is_own || (!needs_error(when) && !is_guard(program_, condition));
            });
            return is_own && any_effect(rule, [](MotionEffect effect) {
                       return effect == MotionEffect::init || effect == MotionEffect::stop ||
                              effect == MotionEffect::speed;
                   });
        });
    }

    const StepPlan* behind_helper(const StepPlan& step) const {
        if (!step.is_helper || step.rules.empty() || !step.rules.front().action.next) return &step;
        const StepPlan* next = step_numbered(plan_, *step.rules.front().action.next);
        return next == nullptr ? &step : next;
    }

    /// An ON guard, or a branch into the fault step that an input decides while the motor moves.
    bool is_meant(const Truth& when, Span condition, const StepPlan& target) const {
        if (needs_error(when)) return false;
        if (is_guard(program_, condition)) return true;
        if (fault_.length == 0 || target.span != fault_) return false;
        const Truth under_way = when & ~truth_of_bit(kInPosBit) & ~truth_of_bit(kTimerZero) &
                                ~truth_of_bit(kCounterZero) & ~truth_of_bit(kErrorBit);
        for (std::size_t input = kInput0; input < kInPosBit; ++input) {
            if (depends_on(under_way, input)) return true;
        }
        return false;
    }

    /// It sets the motor's motion, or at least its speed. A STOP that ends nothing gets W050.
    static bool is_ordered(const Rule& rule) {
        return std::any_of(rule.action.sends.begin(), rule.action.sends.end(), [](const Send& send) {
            const MotionEffect effect = motion_effect_of(send);
            return effect == MotionEffect::init || effect == MotionEffect::stop ||
                   effect == MotionEffect::speed || moves(effect);
        });
    }

    /// In the following scan, with any inputs.
    bool goes_on_with_order(const StepPlan& step, int depth) const {
        Truth left = ~truth_of_bit(kErrorBit);
        for (const Rule& rule : step.rules) {
            const StepPlan* next =
                depth > 0 && leaves(step, rule) ? step_numbered(plan_, *rule.action.next) : nullptr;
            if (is_ordered(rule) || (next != nullptr && goes_on_with_order(*next, depth - 1)))
                left &= ~rule.when;
        }
        return left.none();
    }

    void warn(Span guard, const StepPlan& target, const MotionState& state) {
        const Span place = target.span.length != 0 ? target.span : guard;
        if (!said_.insert({guard.offset, place.offset}).second) return;
        const bool is_fault = target.span == fault_ && fault_.length != 0;
        Diagnostic& d = report_.add(
            "W042", place,
            fmt::format("'{}' is entered while the motor may move, and nothing stops it", target.name),
            fmt::format("write {} in the step; or ALLOW W042 BECAUSE 'reason';",
                        state.drive.length != 0 ? "ENTRY MODE_REG := 0;" : "ENTRY STOP;"));
        d.notes.push_back(
            {guard, is_fault ? "this leads there, and unlike an ERROR stops nothing" : "this leads there"});
        d.notes.push_back({state.any(), "the motion that began here may continue"});
    }

    const ast::Program& program_;
    const Plan& plan_;
    Report& report_;
    Span fault_;
    MotionState before_;
    const StepPlan* step_ = nullptr;
    std::set<std::pair<std::uint32_t, std::uint32_t>> said_;
    std::set<std::uint32_t> entered_at_rest_;  ///< steps, by their place
    std::vector<Run> runs_;
};

}  // namespace

void check_guards(const ast::Program& program, const Plan& plan, Scope& scope, Report& report) {
    if (has_terms(plan)) return;
    const auto fault = program.on_error ? scope.step(*program.on_error) : std::nullopt;
    MotionWalk walk(program, plan, fault, report);
    MotionState at_power_up;
    at_power_up.known = at_power_up.may_stand = true;
    walk_steps(plan, at_power_up, walk);
    walk.judge_runs();
}

}  // namespace nplc::seqc
