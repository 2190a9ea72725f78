// What is sound and yet seldom meant: a step may ALLOW it with a reason.
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
    if (send.reg != nullptr) return false;
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

/// The inputs with which a rule can hold while there is no ERROR, or with one.
Images images_of(const Truth& when, bool with_error) {
    Images images;
    for (std::size_t at = 0; at < kCases; ++at) {
        const bool has_error = ((at >> kErrorBit) & 1U) != 0;
        if (when.test(at) && (with_error || !has_error)) images.set(at & (images.size() - 1));
    }
    return images;
}

/// Whether the motor may move again after a fault while no input changes but those that the fault is about.
class Restart {
  public:
    Restart(const ast::Program& program, const Plan& plan, Scope& scope, Report& report)
        : program_(program), plan_(plan), scope_(scope), report_(report) {}

    void run() {
        if (!program_.on_error) return;
        const auto fault = scope_.step(*program_.on_error);
        if (!fault) return;
        find_causes();
        for (const StepPlan& step : plan_.steps) {
            if (step.number != *fault) continue;
            for (const Rule& rule : step.rules) judge_exit(step, rule);
        }
    }

  private:
    /// The inputs that lead to the fault step, and with which level: `ON NOT Well`, `IF Door THEN`.
    void find_causes() {
        for (const ast::OnCondition& on : program_.on_conditions) {
            if (leads_to_fault(on.next)) add_causes(on.condition);
        }
        for (const ast::Step& step : program_.steps) {
            for (const ast::Choice& choice : step.choices) {
                for (const ast::Branch& branch : choice.branches) {
                    if (branch.condition && std::any_of(branch.statements.begin(), branch.statements.end(),
                                                        [&](const auto& one) { return leads_to_fault(one); }))
                        add_causes(*branch.condition);
                }
            }
        }
    }

    bool leads_to_fault(const ast::Statement& statement) const {
        return statement.kind == ast::Statement::Kind::next &&
               same_name(statement.name.text, program_.on_error->text);
    }

    void add_causes(const ast::Expression& condition) {
        if (has_edge(condition)) return;
        const Truth when = scope_.truth_of(condition);
        for (std::size_t bit = 0; bit < kInputCount; ++bit) {
            const Truth on = when & truth_of_bit(bit);
            const Truth off = when & ~truth_of_bit(bit);
            const std::size_t step = std::size_t{1} << bit;
            if ((on & ~(off << step)).any()) causes_[1].set(bit);
            if ((off & ~(on >> step)).any()) causes_[0].set(bit);
        }
    }

    static bool has_edge(const ast::Expression& condition) {
        return condition.kind == ast::Expression::Kind::rising ||
               condition.kind == ast::Expression::Kind::falling ||
               std::any_of(condition.operands.begin(), condition.operands.end(), has_edge);
    }

    /// Whether a condition asks for an input, and for more than that it tells of no fault any more.
    bool asks_for(const Truth& when, std::size_t bit) const {
        if (!depends_on(when, bit)) return false;
        const bool needs_on = (when & ~truth_of_bit(bit)).none();
        const bool needs_off = (when & truth_of_bit(bit)).none();
        return !(needs_on && causes_[0].test(bit)) && !(needs_off && causes_[1].test(bit));
    }

    void judge_exit(const StepPlan& step, const Rule& rule) {
        if (!leaves(step, rule) || rule.condition.length == 0) return;
        for (std::size_t bit = 0; bit < kInputCount; ++bit) {
            if (asks_for(rule.when, bit)) return;
        }
        const Send* motion = motion_of(rule);
        if (motion == nullptr)
            motion = motion_from(*rule.action.next, images_of(rule.when, true), step.number);
        if (motion == nullptr) return;
        report_
            .add("W037", rule.condition,
                 "the motor may start again by itself after a fault: no person is asked here",
                 "ask for an acknowledgement, as in ANY ERROR AND Ack; or write ALLOW W037 BECAUSE 'reason'; "
                 "in the step")
            .notes.push_back({motion->span, "it comes to this with all inputs left as they are"});
    }

    /// Follows the steps with each image of the inputs held.
    const Send* motion_from(std::uint8_t first, const Images& held, std::uint8_t fault) const {
        std::array<Images, 64> seen;
        std::deque<std::uint8_t> open = {first};
        seen[first] = held;
        while (!open.empty()) {
            const std::uint8_t number = open.front();
            open.pop_front();
            for (const StepPlan& step : plan_.steps) {
                if (step.number != number) continue;
                for (const Rule& rule : step.rules) {
                    const Images on = seen[number] & images_of(rule.when, false);
                    const std::uint8_t next = rule.action.next.value_or(number);
                    if (on.none() || next == fault) continue;
                    if (const Send* motion = motion_of(rule)) return motion;
                    if ((on & ~seen[next]).none()) continue;
                    seen[next] |= on;
                    open.push_back(next);
                }
            }
        }
        return nullptr;
    }

    const ast::Program& program_;
    const Plan& plan_;
    Scope& scope_;
    Report& report_;
    std::array<std::bitset<kInputCount>, 2> causes_;  ///< by the level that leads to the fault step
};

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
    Restart(program, plan, scope, report).run();
}

void check_arrivals(const Plan& plan, Report& report) {
    Arrivals(plan, report).run();
}

}  // namespace nplc::seqc
