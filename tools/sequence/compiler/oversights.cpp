#include "compiler/oversights.h"

#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <set>
#include <utility>

#include "compiler/checker.h"
#include "compiler/orders.h"
#include "compiler/scope.h"
#include "symbols/commands.h"
#include "symbols/units.h"

namespace nplc::seqc {
namespace {

using table::Group;

/// From the manufacturers' data sheets; a MAC800 above it stops with an error (004).
constexpr double kTopSpeedSmall = 4000;
constexpr double kTopSpeedMac800 = 3600;

/// True when the bit is 1 and false when it is 0.
bool waits_for(const Truth& when, std::size_t bit) {
    const Truth with = when & truth_of_bit(bit);
    return (with & ~(when << (std::size_t{1} << bit))).any();
}

class Oversights {
  public:
    Oversights(const ast::Program& program, const Plan& plan, const Symbols& symbols,
               const std::vector<DeclaredSetPoint>& points, Report& report)
        : program_(program), plan_(plan), symbols_(symbols), points_(points), report_(report) {
        for (const StepPlan& step : plan.steps) has_terms_ = has_terms_ || !step.terms.empty();
        has_terms_ = has_terms_ || !plan.terms.empty();
    }

    void run() {
        check_speeds();
        check_unset_registers();
        if (has_terms_) return;  // the terms may do what is missing
        check_presets(kTimerZero, "W020", "TIMER.Q", "the timer", "TIMER := T#500ms; on the way to the step");
        check_presets(kCounterZero, "W020", "COUNTER.Q", "the counter",
                      "COUNTER := 5; on the way to the step");
        check_endless_counts(plan_, report_);
        find_fault();
        check_exits();
        check_reset();
        check_watchdogs();
    }

  private:
    template <class Visit>
    void for_each_rule(const Visit& visit) const {
        for (const StepPlan& step : plan_.steps) {
            for (const Rule& rule : step.rules) visit(step, rule);
        }
    }

    void check_speeds() {
        if (symbols_.drive != nullptr) return;
        const bool large = symbols_.motor == registers::Model::mac800;
        const double top = large ? kTopSpeedMac800 : kTopSpeedSmall;
        std::set<std::uint32_t> said;
        for_each_send(plan_, [&](const Send& send) {
            if (!is_speed(send.reg) || send.set_point != 0) return;
            const double rpm = rpm_of(*send.reg, send.value);
            if (rpm <= top + 1 || !said.insert(send.span.offset).second) return;
            warn_of_speed(send.span, rpm, top);
        });
        for (const DeclaredSetPoint& declared : points_) {
            if (!is_speed(declared.reg) || !declared.is_sound) continue;
            const double at_low = rpm_of(*declared.reg, bits_of(declared.point.lowest, *declared.reg));
            const double at_high = rpm_of(*declared.reg, bits_of(declared.point.highest, *declared.reg));
            const bool by_high = at_high >= at_low;
            const double rpm = std::max(at_low, at_high);
            if (rpm > top + 1)
                warn_of_speed((by_high ? declared.written->high : declared.written->low).span, rpm, top);
        }
    }

    void warn_of_speed(Span span, double rpm, double top) {
        report_.add(
            "W018", span,
            fmt::format("{:.0f} rpm is more than a {} reaches: {:.0f} rpm", rpm,
                        registers::name_of(symbols_.motor), top),
            "write a smaller value, or check SCALE: it says how far the machine moves in a revolution");
    }

    static bool is_speed(const registers::Register* reg) {
        return reg != nullptr && (reg->number == registers::V_SOLL || is_selectable(reg->number, Group::v));
    }

    double rpm_of(const registers::Register& reg, std::uint32_t value) const {
        const auto per_rpm = raw_per_unit(reg, symbols_.motor, {}, "rpm");
        return per_rpm ? std::fabs(number_of_bits(value, reg.format)) / *per_rpm : 0;
    }

    static bool is_selectable(std::uint8_t number, Group group) {
        const auto selection = selection_of(number);
        return selection && selection->group == group;
    }

    /// A program without such values relies on the motor's own; a name without a value states that
    /// explicitly.
    void check_unset_registers() {
        if (symbols_.drive != nullptr) return;
        std::set<std::pair<Group, std::uint8_t>> set;
        const auto add = [&](std::uint8_t number) {
            if (const auto selection = selection_of(number)) set.emplace(selection->group, selection->index);
        };
        for_each_send(plan_, [&](const Send& send) {
            if (send.reg != nullptr) add(send.reg->number);
        });
        if (set.empty()) return;
        for (const MotorName& named : symbols_.motor_names) add(named.number);
        for_each_send(plan_, [&](const Send& send) {
            const auto selection = selected_by(send);
            if (!selection || !set.emplace(selection->group, selection->index).second) return;
            const std::string reg = register_name(*selection);
            report_.add("W023", send.span,
                        fmt::format("{} is selected here, but nothing gives it a value", reg),
                        fmt::format("write Name AT {0} := value; in VAR_MOTOR, or Name AT {0}; if the motor "
                                    "has a value in its memory or it is set elsewhere",
                                    reg));
        });
    }

    static std::optional<Selection> selected_by(const Send& send) {
        if (send.reg != nullptr) return std::nullopt;
        if (const auto select = select_command(send.command)) return select->selection;
        const auto move = table::relative_move(send.command);
        return move ? std::optional(Selection{Group::p, move->index}) : std::nullopt;
    }

    void check_presets(std::size_t bit, Code code, const char* test, const char* what, const char* how) {
        bool is_preset = false;
        const Rule* first = nullptr;
        for_each_rule([&](const StepPlan&, const Rule& rule) {
            is_preset = is_preset ||
                        (bit == kTimerZero ? rule.action.timer.has_value() : rule.action.counter.has_value());
            if (first == nullptr && waits_for(rule.when, bit)) first = &rule;
        });
        if (is_preset || first == nullptr) return;
        report_.add(code, first->condition, fmt::format("{} is true at once: nothing presets {}", test, what),
                    fmt::format("write {}", how));
    }

    bool has_lost_step() const {
        std::bitset<64> entered;
        for_each_rule([&](const StepPlan& step, const Rule& rule) {
            if (leaves(step, rule)) entered.set(*rule.action.next);
        });
        return std::any_of(plan_.steps.begin(), plan_.steps.end(), [&](const StepPlan& step) {
            return step.number != 0 && !step.is_helper && !step.is_copy &&
                   !any_copy(step, [&](const StepPlan& copy) { return entered.test(copy.number); });
        });
    }

    /// A step and its copies count as one.
    template <class Test>
    bool any_copy(const StepPlan& step, const Test& test) const {
        return std::any_of(plan_.steps.begin(), plan_.steps.end(), [&](const StepPlan& other) {
            return (&other == &step || (other.is_copy && other.span == step.span)) && test(other);
        });
    }

    bool is_of_on(Span condition) const {
        return std::any_of(program_.on_conditions.begin(), program_.on_conditions.end(),
                           [&](const ast::OnCondition& on) { return on.condition.span == condition; });
    }

    /// A branch of the step itself: neither an ON condition for many steps, nor an input that leads to the
    /// fault step.
    bool is_exit(const StepPlan& step, std::uint8_t next, const Truth& when, Span condition) const {
        if (is_of_on(condition) || (!step.own_error && (when & ~truth_of_bit(kErrorBit)).none()))
            return false;
        const bool waits =
            depends_on(when, kInPosBit) || depends_on(when, kTimerZero) || depends_on(when, kCounterZero);
        const bool is_guard = fault_ != nullptr && !waits && condition.length != 0 && !step.own_error;
        return !is_guard || !steps_are_one(*fault_, next);
    }

    bool is_exit(const StepPlan& step, const Rule& rule, const RulePart* but = nullptr) const {
        if (!leaves(step, rule)) return false;
        if (step.is_helper) return true;  // on the way to the target of another step's branch
        if (rule.parts.empty()) return is_exit(step, *rule.action.next, rule.when, rule.condition);
        return std::any_of(rule.parts.begin(), rule.parts.end(), [&](const RulePart& part) {
            return &part != but && is_exit(step, *rule.action.next, part.when, part.condition);
        });
    }

    bool steps_are_one(const StepPlan& step, std::uint8_t number) const {
        return any_copy(step, [&](const StepPlan& copy) { return copy.number == number; });
    }

    void find_fault() {
        for_each_rule([&](const StepPlan& step, const Rule& rule) {
            const bool on_error = (rule.when & truth_of_bit(kErrorBit)).any();
            if (on_error && leaves(step, rule) && !step.own_error)
                fault_ = step_numbered(plan_, *rule.action.next);
        });
    }

    void check_exits() {
        std::bitset<64> entered;
        for_each_rule([&](const StepPlan& step, const Rule& rule) {
            if (step.number != 0 && leaves(step, rule)) entered.set(*rule.action.next);
        });
        const Truth no_error = ~truth_of_bit(kErrorBit);
        const auto leads_on = [&](const StepPlan& step) {
            return std::any_of(step.rules.begin(), step.rules.end(),
                               [&](const Rule& rule) { return is_exit(step, rule); });
        };
        const auto does_something = [&](const StepPlan& step) {
            return step.outputs != 0 || !step.conditional.empty() ||
                   (!step.own_error && !step.entry.empty()) ||
                   std::any_of(step.rules.begin(), step.rules.end(),
                               [&](const Rule& rule) { return (rule.when & no_error).any(); });
        };
        const auto has_guard = [&](const StepPlan& step) {
            return std::any_of(step.rules.begin(), step.rules.end(), [&](const Rule& rule) {
                return leaves(step, rule) && (rule.when & no_error).any();
            });
        };
        for (const StepPlan& step : plan_.steps) {
            const bool is_entered =
                any_copy(step, [&](const StepPlan& copy) { return entered.test(copy.number); });
            // An empty step is an end, unless the program continues in an unreachable step.
            if (step.is_copy || !is_entered || any_copy(step, leads_on) ||
                (!any_copy(step, does_something) && !has_lost_step()))
                continue;
            stuck_.set(step.number);
            report_.add("W019", step.span,
                        fmt::format("'{}' is entered and never left{}", step.name,
                                    any_copy(step, has_guard)              ? " but by a guard"
                                    : step.own_error || step.rules.empty() ? ""
                                                                           : " but by an ERROR"),
                        "write a branch with NEXT, such as IF condition THEN NEXT := Step; END_IF");
        }
    }

    /// An error persists until RESET_ERROR is sent, and a condition that does not name ERROR implies NOT
    /// ERROR.
    void check_reset() {
        const Rule* reset = nullptr;
        bool under_error = false;
        for_each_rule([&](const StepPlan&, const Rule& rule) {
            const bool on_error = (rule.when & truth_of_bit(kErrorBit)).any();
            for (const Send& send : rule.action.sends) {
                if (send.reg != nullptr || kind_of(send) != OrderKind::reset_error) continue;
                reset = &rule;
                under_error = under_error || on_error;
            }
        });
        if (fault_ == nullptr || under_error || stuck_.test(fault_->number)) return;
        if (reset != nullptr) {
            report_.add("W021", reset->condition.length != 0 ? reset->condition : reset->action.span,
                        "RESET_ERROR is never sent while there is an ERROR: this implies NOT ERROR",
                        "write ANY ERROR AND in front of the condition");
            return;
        }
        report_.add("W021", fault_->span,
                    "nothing sends RESET_ERROR: once there was an error the motor stays still",
                    "write IF ANY ERROR AND R_TRIG(Ack) THEN RESET_ERROR; NEXT := POWER_UP; END_IF");
    }

    /// Also if another condition leads to the same step.
    static const RulePart* timer_exit(const StepPlan& step) {
        for (const Rule& rule : step.rules) {
            if (!leaves(step, rule)) continue;
            for (const RulePart& part : rule.parts) {
                if ((part.when & ~truth_of_bit(kTimerZero)).none()) return &part;
            }
        }
        return nullptr;
    }

    /// A step that waits for the timer is entered while the time limit of the previous step runs, and both
    /// lead to different steps.
    void check_watchdogs() {
        for_each_rule([&](const StepPlan& from, const Rule& rule) {
            if (!leaves(from, rule) || rule.action.timer || (rule.when & ~truth_of_bit(kTimerZero)).none())
                return;
            const RulePart* limit = timer_exit(from);
            const StepPlan* to = step_numbered(plan_, *rule.action.next);
            const RulePart* dwell = to == nullptr ? nullptr : timer_exit(*to);
            if (limit == nullptr || dwell == nullptr || limit->action.next == dwell->action.next) return;
            const bool waits_only = std::none_of(to->rules.begin(), to->rules.end(), [&](const Rule& other) {
                return is_exit(*to, other, dwell);
            });
            if (!waits_only) return;
            report_
                .add(
                    "W022", dwell->condition,
                    fmt::format("'{}' waits for what is left of the time limit of '{}'", to->name, from.name),
                    fmt::format("preset the timer on the way: TIMER := T#500ms; NEXT := {};", to->name))
                .notes.push_back({rule.action.next_span, "it is entered from here, with the timer running"});
        });
    }

    const ast::Program& program_;
    const Plan& plan_;
    const Symbols& symbols_;
    const std::vector<DeclaredSetPoint>& points_;
    Report& report_;
    const StepPlan* fault_ = nullptr;  ///< of ON ERROR
    bool has_terms_ = false;
    std::bitset<64> stuck_;
};

}  // namespace

void check_oversights(const ast::Program& program, const Plan& plan, const Symbols& symbols,
                      const std::vector<DeclaredSetPoint>& points, Report& report) {
    Oversights(program, plan, symbols, points, report).run();
}

}  // namespace nplc::seqc
