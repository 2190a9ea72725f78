// Steps that a guard leads to while the motor may move.
#include "compiler/guards.h"

#include <fmt/format.h>

#include <array>
#include <set>
#include <utility>

#include "compiler/checker.h"
#include "compiler/orders.h"
#include "compiler/step_walk.h"

namespace nplc::seqc {
namespace {

/// The motions that may be under way, by the orders that began them; length 0: none.
struct MotionState {
    bool known = false;
    Span run;
    Span place;
    Span drive;

    bool is_known() const { return known; }
    bool join(const MotionState& other) {
        bool news = !known;
        known = true;
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
    void stand() { run = place = drive = {}; }
    /// INPOS is "at speed" of a run.
    void arrive() { place = drive = {}; }
    Span any() const { return run.length != 0 ? run : place.length != 0 ? place : drive; }
};

class MotionWalk {
  public:
    using State = MotionState;

    MotionWalk(const ast::Program& program, const Plan& plan, std::optional<std::uint8_t> fault,
               Report& report)
        : program_(program), plan_(plan), report_(report) {
        if (const StepPlan* step = fault ? step_numbered(*fault) : nullptr) fault_ = step->span;
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
        if (effect == MotionEffect::stop) state.run = state.place = {};
        if (effect != MotionEffect::init && !moves(effect)) return;
        state.stand();
        if (effect == MotionEffect::run) state.run = send.span;
        if (effect == MotionEffect::place) state.place = send.span;
        if (outlasts_stop(effect)) state.drive = send.span;
    }

    void judge(const Rule& rule, const MotionState&) {
        if (!leaves(*step_, rule) || before_.any().length == 0) return;
        const StepPlan* to = step_numbered(*rule.action.next);
        if (to == nullptr) return;
        const StepPlan* target = behind_helper(*to);
        for_each_part(rule, [&](const Truth& when, Span condition) {
            if (!is_meant(when, condition, *target)) return;
            MotionState state = before_;
            if ((when & ~truth_of_bit(kInPosBit)).none()) state.arrive();
            if (state.any().length == 0 || is_ordered(rule) || goes_on_with_order(*to, 3)) return;
            warn(condition, *target, state);
        });
    }

  private:
    const StepPlan* step_numbered(std::uint8_t number) const {
        const auto found = std::find_if(plan_.steps.begin(), plan_.steps.end(),
                                        [&](const StepPlan& step) { return step.number == number; });
        return found == plan_.steps.end() ? nullptr : &*found;
    }

    const StepPlan* behind_helper(const StepPlan& step) const {
        if (!step.is_helper || step.rules.empty() || !step.rules.front().action.next) return &step;
        const StepPlan* next = step_numbered(*step.rules.front().action.next);
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
                depth > 0 && leaves(step, rule) ? step_numbered(*rule.action.next) : nullptr;
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
};

}  // namespace

void check_guards(const ast::Program& program, const Plan& plan, Scope& scope, Report& report) {
    if (has_terms(plan)) return;
    const auto fault = program.on_error ? scope.step(*program.on_error) : std::nullopt;
    MotionWalk walk(program, plan, fault, report);
    MotionState at_power_up;
    at_power_up.known = true;
    walk_steps(plan, at_power_up, walk);
}

}  // namespace nplc::seqc
