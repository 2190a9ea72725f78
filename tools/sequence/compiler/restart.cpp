// Whether a machine moves, or resets a fault, without a command: after a fault, after a guard, at power-up.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <deque>
#include <string>
#include <vector>

#include "compiler/checker.h"
#include "compiler/guards.h"
#include "compiler/orders.h"

namespace nplc::seqc {
namespace {

constexpr std::size_t kInputCount = 6;
constexpr std::size_t kImages = std::size_t{1} << kInputCount;
using Images = std::bitset<kImages>;

/// The inputs with which a rule can hold while there is no ERROR, or with one.
Images images_of(const Truth& when, bool with_error) {
    Images images;
    for (std::size_t at = 0; at < kCases; ++at) {
        const bool has_error = ((at >> kErrorBit) & 1U) != 0;
        if (when.test(at) && (with_error || !has_error)) images.set(at & (kImages - 1));
    }
    return images;
}

/// The images in which an input is on.
Images images_with(std::size_t input) {
    Images images;
    for (std::size_t at = 0; at < kImages; ++at) images.set(at, ((at >> input) & 1U) != 0);
    return images;
}

/// Those that differ from one of `images` in the inputs of `free` alone.
Images with_free(const Images& images, std::size_t free) {
    std::bitset<kImages> kept;
    for (std::size_t at = 0; at < kImages; ++at) {
        if (images.test(at)) kept.set(at & ~free);
    }
    Images result;
    for (std::size_t at = 0; at < kImages; ++at) result.set(at, kept.test(at & ~free));
    return result;
}

/// Images with which the motor is moved, and by what.
struct Moved {
    Images images;
    const Send* first = nullptr;

    void add(const Images& more, const Send* send) {
        if (send == nullptr || more.none()) return;
        images |= more;
        if (first == nullptr) first = send;
    }
};

/// By step, the inputs with which it can be active.
using Reached = std::array<Images, 64>;

/// Whether the motor may move again while no input changes. An acknowledgement is an input that must change,
/// or that must be on and is tested nowhere else. Steps that remember an edge are separate copies here, so
/// that R_TRIG and F_TRIG do not hold for an input that stays.
class Restart {
  public:
    Restart(const ast::Program& program, const Plan& plan, std::optional<std::uint8_t> fault, Report& report)
        : program_(program), plan_(plan), report_(report) {
        for (const StepPlan& step : plan.steps) steps_.at(step.number) = &step;
        if (fault && steps_.at(*fault) != nullptr) fault_span_ = steps_.at(*fault)->span;
    }

    void after_fault() {
        if (fault_span_.length == 0) return;
        here_ = fault_span_;
        Reached in_fault;
        for (const StepPlan& step : plan_.steps) {
            if (is_fault(step.number)) continue;
            for (const Rule& rule : step.rules) {
                if (rule.action.next && is_fault(*rule.action.next)) in_fault.at(*rule.action.next).set();
            }
        }
        const std::vector<Exit> exits = exits_of(in_fault);
        for (const Exit& exit : exits) judge(exit, motion_behind(exit), {});
    }

    /// A guard that orders a move itself holds nothing back.
    void after_guard(const ast::OnCondition& on) {
        Images on_images;
        Reached entered;
        bool moves_itself = false;
        for_each_entry(on, [&](const Truth& when, const Rule& rule) {
            const Images images = images_of(when, false);
            const std::uint8_t next = *rule.action.next;
            moves_itself = moves_itself || motion_of(rule) != nullptr;
            on_images |= images;
            entered.at(next) |= images;
            here_ = steps_.at(next)->span;
        });
        const std::size_t asked = inputs_of(on_images);
        if (asked == 0 || moves_itself || here_ == fault_span_) return;
        Moved while_on;
        for (const Exit& exit : exits_of(entered)) {
            const Moved motion = motion_behind(exit);
            while_on.add(motion.images, motion.first);
        }
        Reached released;
        for (std::size_t i = 0; i < released.size(); ++i)
            released[i] = with_free(entered[i], asked) & ~on_images;
        const Images moves_anyway = with_free(while_on.images, asked);
        for (const Exit& exit : exits_of(released)) {
            Moved motion = motion_behind(exit);
            motion.images &= ~moves_anyway;
            if (motion.images.any()) judge(exit, motion, on.condition.span);
        }
    }

    /// Whatever the inputs are, as long as no guard holds. Where the motor may start again too, that is said.
    void automatic_reset() {
        if (fault_span_.length == 0 || restarts_) return;
        const Images held = without_guards();
        Images reset;
        const Rule* by = nullptr;
        const Send* order = nullptr;
        Reached seen;
        std::deque<std::uint8_t> open;
        const auto follow = [&](const Rule& rule, const Images& on) {
            const auto sent =
                std::find_if(rule.action.sends.begin(), rule.action.sends.end(),
                             [](const Send& send) { return kind_of(send) == OrderKind::reset_error; });
            if (sent != rule.action.sends.end()) {
                reset |= on;
                if (order == nullptr) {
                    by = &rule;
                    order = &*sent;
                }
            } else if (rule.action.next && (on & ~seen.at(*rule.action.next)).any()) {
                seen.at(*rule.action.next) |= on;
                open.push_back(*rule.action.next);
            }
        };
        for (const StepPlan& step : plan_.steps) {
            for (const Rule& rule : step.rules) {
                if (!is_fault(step.number) && rule.action.next && is_fault(*rule.action.next) &&
                    needs_error(rule.when))
                    follow(rule, held);
            }
        }
        for (; !open.empty(); open.pop_front()) {
            const StepPlan* step = steps_.at(open.front());
            if (step == nullptr) continue;
            for (const Rule& rule : step->rules) {
                const Images on =
                    seen.at(step->number) & images_of(rule.when & truth_of_bit(kErrorBit), true);
                if (on.any()) follow(rule, on);
            }
        }
        if (order == nullptr || reset != held) return;
        const bool has_condition = by->condition.length != 0 && !is_on_error(by->condition);
        report_.add("W049", has_condition ? by->condition : order->span,
                    "an ERROR is reset here by itself: no acknowledgement is asked for on the way from it",
                    "wait for a button to be pressed, as in ANY ERROR AND R_TRIG(Ack); or write ALLOW W049 "
                    "BECAUSE 'reason'; in the step");
    }

    /// Whatever the inputs are, as long as no guard holds.
    void at_power_up() {
        if (steps_.front() == nullptr) return;
        here_ = {};
        Exit exit{};
        exit.next = 0;
        exit.held = without_guards();
        const Moved motion = motion_behind(exit);
        if (motion.images != exit.held) return;
        report_.add(
            "W044", motion.first->span,
            "the motor moves after power-up by itself: no input has to change before",
            "wait for a button first, as in STEP Idle: IF R_TRIG(Start) THEN NEXT := ..; or write ALLOW "
            "W044 BECAUSE 'reason'; in the step");
    }

  private:
    /// How a step is left, and the inputs that are held then.
    struct Exit {
        const Rule* rule = nullptr;
        std::uint8_t next = 0;
        Images held;
    };

    bool is_on_error(Span condition) const {
        return program_.on_error && program_.on_error->span == condition;
    }

    /// The inputs with which no guard holds; all, if there are none.
    Images without_guards() const {
        Images guarded;
        for (const ast::OnCondition& on : program_.on_conditions)
            for_each_entry(on, [&](const Truth& when, const Rule&) { guarded |= images_of(when, false); });
        return guarded.all() ? guarded : ~guarded;
    }

    bool is_fault(std::uint8_t number) const {
        return fault_span_.length != 0 && steps_.at(number) != nullptr &&
               steps_.at(number)->span == fault_span_;
    }
    bool is_here(std::uint8_t number) const {
        return here_.length != 0 && steps_.at(number) != nullptr && steps_.at(number)->span == here_;
    }

    /// The rules by which a guard leads to its step.
    template <class Visit>
    void for_each_entry(const ast::OnCondition& on, const Visit& visit) const {
        for (const StepPlan& step : plan_.steps) {
            for (const Rule& rule : step.rules) {
                if (!rule.action.next || steps_.at(*rule.action.next) == nullptr) continue;
                for_each_part(rule, [&](const Truth& when, Span condition) {
                    if (condition == on.condition.span) visit(when, rule);
                });
            }
        }
    }

    /// In other steps than the fault step and the one that is looked at.
    bool is_asked_elsewhere(std::size_t input) const {
        return std::any_of(plan_.steps.begin(), plan_.steps.end(), [&](const StepPlan& step) {
            return !is_fault(step.number) && !is_here(step.number) &&
                   std::any_of(step.rules.begin(), step.rules.end(),
                               [&](const Rule& rule) { return depends_on(rule.when, input); });
        });
    }

    static std::size_t inputs_of(const Images& images) {
        std::size_t inputs = 0;
        for (std::size_t at = 0; at < kImages; ++at) {
            for (std::size_t input = 0; input < kInputCount; ++input) {
                const std::size_t bit = std::size_t{1} << input;
                if (images.test(at) != images.test(at ^ bit)) inputs |= bit;
            }
        }
        return inputs;
    }

    /// It requires a button that is used for this only. An input that also starts a move does not acknowledge
    /// a guard.
    bool is_acknowledged(const Rule& rule, bool by_guard) const {
        if (by_guard && motion_of(rule) != nullptr) return false;
        const Images when = images_of(rule.when, true);
        for (std::size_t input = 0; input < kInputCount; ++input) {
            if ((when & ~images_with(input)).none() && !is_asked_elsewhere(input)) return true;
        }
        return false;
    }

    /// Follows the steps with each image of the inputs held, as far as `goes_on` lets it.
    template <class GoesOn>
    void walk(Reached& seen, const GoesOn& goes_on) const {
        std::deque<std::uint8_t> open;
        for (std::uint8_t number = 0; number < seen.size(); ++number) {
            if (seen.at(number).any()) open.push_back(number);
        }
        for (; !open.empty(); open.pop_front()) {
            const StepPlan* step = steps_.at(open.front());
            if (step == nullptr) continue;
            const bool with_error = is_fault(step->number);
            for (const Rule& rule : step->rules) {
                const Images on = seen.at(step->number) & images_of(rule.when, with_error);
                const std::uint8_t next = rule.action.next.value_or(step->number);
                if (on.none() || !goes_on(*step, rule, next, on) || (on & ~seen.at(next)).none()) continue;
                seen.at(next) |= on;
                open.push_back(next);
            }
        }
    }

    /// Those of the step that is looked at, which is entered with `seen`: filled in for its copies.
    std::vector<Exit> exits_of(Reached& seen) const {
        std::vector<Exit> exits;
        walk(seen, [&](const StepPlan& step, const Rule& rule, std::uint8_t next, const Images& on) {
            if (!is_here(step.number)) return false;
            if (is_here(next)) return true;
            exits.push_back({&rule, next, on});
            return false;
        });
        return exits;
    }

    /// Not through the fault step, nor through the step that is looked at.
    Moved motion_behind(const Exit& exit) const {
        Moved motion;
        if (exit.rule != nullptr) motion.add(exit.held, motion_of(*exit.rule));
        if (is_fault(exit.next)) return motion;
        Reached seen;
        seen.at(exit.next) = exit.held;
        walk(seen, [&](const StepPlan&, const Rule& rule, std::uint8_t next, const Images& on) {
            if (is_fault(next) || is_here(next)) return false;
            motion.add(on, motion_of(rule));
            return true;
        });
        return motion;
    }

    /// `guard`: what is over; empty: a fault.
    void judge(const Exit& exit, const Moved& motion, Span guard) {
        const Rule& rule = *exit.rule;
        const Span written = rule.condition.length != 0 ? rule.condition : rule.action.next_span;
        const Span place = is_guard(program_, written) ? here_ : written;  // a step can ALLOW it
        const bool by_guard = guard.length != 0;
        if (motion.first == nullptr || report_.has("W037", place) || is_acknowledged(rule, by_guard)) return;
        restarts_ = restarts_ || !by_guard;
        Diagnostic& d = report_.add(
            "W037", place,
            by_guard ? "the motor may start again by itself when the guard of this step ends: no other input "
                       "has to change on the way"
                     : "the motor may start again by itself after a fault: no input has to change on the way",
            fmt::format("wait for a button to be pressed, as in {}R_TRIG(Ack); or write ALLOW W037 "
                        "BECAUSE 'reason'; in the step",
                        by_guard ? "IF Well AND " : "ANY ERROR AND "));
        d.notes.push_back({motion.first->span, "this is reached with all inputs unchanged"});
        if (by_guard) d.notes.push_back({guard, "the guard is this one"});
    }

    const ast::Program& program_;
    const Plan& plan_;
    Report& report_;
    std::array<const StepPlan*, 64> steps_{};
    Span fault_span_;
    Span here_;              ///< the step that is looked at
    bool restarts_ = false;  ///< after a fault
};

}  // namespace

void check_restart(const ast::Program& program, const Plan& plan, Scope& scope, Report& report) {
    Restart restart(program, plan, program.on_error ? scope.step(*program.on_error) : std::nullopt, report);
    restart.after_fault();
    if (has_terms(plan)) return;
    restart.automatic_reset();
    for (const ast::OnCondition& on : program.on_conditions) restart.after_guard(on);
    restart.at_power_up();
}

}  // namespace nplc::seqc
