// Advice about valid but rarely intended code: a step may ALLOW it with a reason.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <deque>
#include <set>

#include "semantics/checker.h"
#include "semantics/commands.h"
#include "syntax/names.h"

namespace nplc::seqc {
namespace {

using protocol::fastmac::Group;
using protocol::fastmac::Mode;
using protocol::fastmac::Number;

constexpr std::size_t kInputCount = 6;
using Images = std::bitset<std::size_t{1} << kInputCount>;

bool orders_motion(const Send& send) {
    if (send.reg != nullptr) return send.reg->number == registers::MODE_REG && send.value != 0;
    if (const auto select = select_command(send.command))
        return select->mode == Mode::velocity ||
               (select->mode == Mode::position && select->selection.group == Group::p);
    switch (static_cast<Number>(send.command & 0x1F)) {
        case Number::home:
        case Number::move_p7_by_p_fnc:
        case Number::move_p8_by_p_fnc:
        case Number::move_p7_by_p_soll:
        case Number::move_p8_by_p_soll:
            return true;
        default:
            return false;
    }
}

const Send* motion_of(const Rule& rule) {
    for (const Send& send : rule.action.sends) {
        if (orders_motion(send)) return &send;
    }
    return nullptr;
}

/// The input images in which a rule can be true without ERROR, or with it.
Images images_of(const Truth& when, bool with_error) {
    Images images;
    for (std::size_t at = 0; at < kCases; ++at) {
        const bool has_error = ((at >> kErrorBit) & 1U) != 0;
        if (when.test(at) && (with_error || !has_error)) images.set(at & (images.size() - 1));
    }
    return images;
}

/// The images with an input on.
Images images_with(std::size_t input) {
    Images images;
    for (std::size_t at = 0; at < images.size(); ++at) images.set(at, ((at >> input) & 1U) != 0);
    return images;
}

/// Whether the motor may move again after a fault without an input change: an acknowledgement is an input
/// that had to change, or that must be on and is not used elsewhere. Steps with edge memory are copies here,
/// so R_TRIG and F_TRIG are false for a constant input.
class Restart {
  public:
    Restart(const Plan& plan, std::uint8_t fault, Report& report) : plan_(plan), report_(report) {
        for (const StepPlan& step : plan.steps) {
            steps_.at(step.number) = &step;
            if (step.number == fault) fault_span_ = step.span;
        }
        for (std::size_t input = 0; input < kInputCount; ++input) {
            if (!is_asked_elsewhere(input)) acknowledgements_.push_back(images_with(input));
        }
    }

    void run() {
        Seen in_fault;
        for (const StepPlan& step : plan_.steps) {
            if (is_fault(step.number)) continue;
            for (const Rule& rule : step.rules) {
                if (rule.action.next && is_fault(*rule.action.next)) in_fault.at(*rule.action.next).set();
            }
        }
        walk(in_fault, [&](const StepPlan& step, const Rule& rule, std::uint8_t next) {
            if (is_fault(step.number) && is_fault(next)) return true;
            judge_exit(rule, in_fault.at(step.number) & images_of(rule.when, true));
            return false;
        });
    }

  private:
    /// By step: the images with which it can be active.
    using Seen = std::array<Images, 64>;

    bool is_fault(std::uint8_t number) const {
        return steps_.at(number) != nullptr && steps_.at(number)->span == fault_span_;
    }

    bool is_asked_elsewhere(std::size_t input) const {
        return std::any_of(plan_.steps.begin(), plan_.steps.end(), [&](const StepPlan& step) {
            return !is_fault(step.number) &&
                   std::any_of(step.rules.begin(), step.rules.end(),
                               [&](const Rule& rule) { return depends_on(rule.when, input); });
        });
    }

    bool is_acknowledged(const Rule& rule) const {
        const Images when = images_of(rule.when, true);
        return std::any_of(acknowledgements_.begin(), acknowledgements_.end(),
                           [&](const Images& on) { return (when & ~on).none(); });
    }

    /// Follows the steps with each image held constant, as far as `goes_on` allows.
    template <class GoesOn>
    void walk(Seen& seen, const GoesOn& goes_on) const {
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
                if (on.none() || !goes_on(*step, rule, next) || (on & ~seen.at(next)).none()) continue;
                seen.at(next) |= on;
                open.push_back(next);
            }
        }
    }

    void judge_exit(const Rule& rule, const Images& held) {
        const Span place = rule.condition.length != 0 ? rule.condition : rule.action.next_span;
        if (report_.has("W037", place) || is_acknowledged(rule)) return;
        const Send* motion = motion_of(rule);
        Seen seen;
        seen.at(*rule.action.next) = held;
        if (motion == nullptr) {
            walk(seen, [&](const StepPlan&, const Rule& other, std::uint8_t next) {
                if (motion == nullptr && !is_fault(next)) motion = motion_of(other);
                return motion == nullptr && !is_fault(next);
            });
        }
        if (motion == nullptr) return;
        report_
            .add("W037", place,
                 "the motor may start again by itself after a fault: no input has to change on the way",
                 "wait for a button to be pressed, as in ANY ERROR AND R_TRIG(Ack); or write ALLOW W037 "
                 "BECAUSE 'reason'; in the step")
            .notes.push_back({motion->span, "it comes to this with all inputs left as they are"});
    }

    const Plan& plan_;
    Report& report_;
    std::array<const StepPlan*, 64> steps_{};
    Span fault_span_;
    /// For each input that only the fault step tests: the images with it on.
    std::vector<Images> acknowledgements_;
};

/// IF INPOS OR TIMER.Q: does not distinguish whether the motor arrived.
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
    Arrivals(const Plan& plan, Report& report) : plan_(plan), report_(report) {
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

    const Plan& plan_;
    Report& report_;
    std::set<std::uint8_t> fault_;
    std::set<std::uint8_t> moving_;
    std::set<std::uint32_t> said_;
};

}  // namespace

void check_restart(const ast::Program& program, const Plan& plan, Scope& scope, Report& report) {
    const auto fault = program.on_error ? scope.step(*program.on_error) : std::nullopt;
    if (fault) Restart(plan, *fault, report).run();
}

void check_arrivals(const Plan& plan, Report& report) {
    Arrivals(plan, report).run();
}

}  // namespace nplc::seqc
