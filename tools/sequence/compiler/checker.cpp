#include "compiler/checker.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "compiler/actions.h"
#include "compiler/on_conditions.h"
#include "compiler/raw_terms.h"
#include "compiler/remember.h"
#include "compiler/seen_branches.h"
#include "compiler/single_term.h"
#include "language/names.h"
#include "sequencer/term.h"
#include "symbols/motors.h"

namespace nplc::seqc {
namespace {

constexpr std::uint8_t kPowerUp = 0;

Truth error_cases() {
    return truth_of_bit(kErrorBit);
}
Truth no_error_cases() {
    return ~error_cases();
}

/// "Start = 1, Guard = 0": one case of `both`, without bits that neither condition depends on.
std::string example_of(const Truth& both, const Truth& a, const Truth& b, const Symbols& symbols) {
    std::size_t first = 0;
    while (first < kCases && !both.test(first)) ++first;
    std::string text;
    for (std::size_t bit = 0; bit < kBits; ++bit) {
        if (!depends_on(a, bit) && !depends_on(b, bit)) continue;
        const bool on = (((first ^ symbols.inverted_inputs) >> bit) & 1U) != 0;
        const std::string_view name = bit < 6             ? std::string_view(symbols.inputs[bit])
                                      : bit == kInPosBit  ? "INPOS"
                                      : bit == kErrorBit  ? "ERROR"
                                      : bit == kTimerZero ? "TIMER.Q"
                                                          : "COUNTER.Q";
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, on ? 1 : 0);
    }
    return text.empty() ? "always" : text;
}

class Checker {
  public:
    Checker(const ast::Program& program, Scope& scope, Report& report, const Symbols& symbols)
        : program_(program), scope_(scope), report_(report), symbols_(symbols) {}

    Plan run() {
        const bool raw_only = program_.steps.empty() && !program_.power_up;
        if (raw_only && program_.terms.empty()) {
            report_.add("E084", program_.name.span, "the program has no steps",
                        "write STEP Name: ... END_STEP");
            return {};
        }
        build_entries();
        find_fault_step();
        on_conditions_ = on_conditions(program_, scope_, fault_);
        check_latched_outputs(program_, scope_);
        Plan plan;
        if (!raw_only) {
            if (const ast::Step* zero = scope_.step_numbered(kPowerUp)) {
                refuse_power_up_beside(*zero);
            } else {
                plan.steps.push_back(power_up());
            }
            for (std::size_t i = 0; i < scope_.steps().size(); ++i) {
                if (scope_.number_of(i) > kLastNamed) continue;
                plan.steps.push_back(step(*scope_.steps()[i], scope_.number_of(i)));
            }
        }
        refuse_silent_steps();
        warn_idle_conditions();
        for (const ast::RawTerm& term : program_.terms) plan.terms.push_back(raw_term(term, {}));
        check_raw_terms(plan, symbols_.drive, report_);
        warn_unreachable(plan, missing_returns(program_, scope_), report_);
        return plan;
    }

  private:
    void build_entries() {
        for (std::size_t i = 0; i < scope_.steps().size(); ++i) {
            ActionBuilder builder(scope_);
            Action& entry = entries_[scope_.number_of(i)];
            entry = builder.build(scope_.steps()[i]->entry);
            if (const auto marked = builder.marked()) {
                report_.add("W006", *marked, "ENTRY happens once by itself", "leave EVERY_SCAN out");
            }
            if (entry.next) {
                report_.add("E064", entry.next_span, "ENTRY cannot hold NEXT",
                            "name the step where the sequence really goes");
                entry.next.reset();
            }
            preset_by_step(*scope_.steps()[i], scope_.number_of(i));
        }
    }

    /// WITHIN and BLINKING preset the timer at every entry of the step.
    void preset_by_step(const ast::Step& written, std::uint8_t number) {
        const Memory& memory = memories_[number] = memory_of(written, scope_);
        const std::uint16_t time = memory.blink_for != 0 ? memory.time_of(0) : memory.limit;
        Action& entry = entries_[number];
        if (time == 0 || entry.timer) return;
        entry.timer = time;
        entry.timer_span = *memory.timer_span;
        entry.timer_by_step = true;
    }

    void find_fault_step() {
        if (!program_.on_error) return;
        fault_ = scope_.step(*program_.on_error);
        const ast::Step* step = fault_ ? scope_.step_numbered(*fault_) : nullptr;
        if (step == nullptr || step->own_error) return;
        report_
            .add("E081", step->name.span,
                 fmt::format("'{}' is the fault step, so it must deal with ERROR itself", step->name.text),
                 "write OWN ERROR; in it")
            .notes.push_back({program_.on_error->span, "it is made the fault step here"});
    }

    void enter(Action& action, std::uint8_t number) {
        action.next = number;
        append_entry(action, entries_[number], report_);
    }

    Rule fault_rule(const std::vector<Send>& before) {
        Rule rule;
        rule.when = error_cases();
        rule.action.span = program_.on_error->span;
        rule.condition = program_.on_error->span;
        rule.action.sends = before;
        enter(rule.action, *fault_);
        return rule;
    }

    /// Register values are sent independent of ERROR, so that a motor that starts with an error gets them
    /// too.
    StepPlan power_up() {
        StepPlan plan;
        plan.name = "POWER_UP";
        plan.number = kPowerUp;
        Action action;
        if (program_.power_up) {
            const ast::Step& written = *program_.power_up;
            plan.span = written.name.span;
            refuse_in_power_up(written);
            add_outputs(written, plan);
            ActionBuilder builder(scope_);
            if (!written.choices.empty())
                action = builder.build(written.choices.front().branches.front().statements);
            if (const auto marked = builder.marked()) {
                report_.add("W006", *marked, "POWER_UP happens once by itself", "leave EVERY_SCAN out");
            }
            if (!action.next || *action.next == kPowerUp) {
                const bool has_if = std::any_of(written.choices.begin(), written.choices.end(),
                                                [](const ast::Choice& choice) { return !choice.bare; });
                if (has_if) return plan;  // E064 was reported
                report_.add("E085", written.name.span, "POWER_UP does not say which step comes first",
                            "end it with NEXT := Name;");
                return plan;
            }
        } else {
            action.next = scope_.number_of(0);
        }
        const std::vector<Send>& values = scope_.initial_values();
        action.sends.insert(action.sends.begin(), values.begin(), values.end());
        enter(action, *action.next);
        plan.rules.push_back({no_error_cases(), action, {}});
        if (fault_) plan.rules.push_back(fault_rule(values));
        return plan;
    }

    void refuse_in_power_up(const ast::Step& written) {
        const auto refuse = [&](Span span, const char* what) {
            report_.add(
                "E064", span, fmt::format("{} cannot stand in POWER_UP", what),
                "POWER_UP happens once: commands, register values and NEXT; put the rest into a step");
        };
        if (!written.conditional.empty()) refuse(written.conditional.front().span, "OUT .. WHEN");
        if (!written.blinking.empty()) refuse(written.blinking.front().span, "BLINKING");
        if (!written.entry.empty()) refuse(written.entry.front().span, "ENTRY");
        if (written.own_error) refuse(written.own_error_span, "OWN ERROR");
        if (written.no_helper) refuse(written.no_helper_span, "NO_HELPER");
        if (written.takes_set_points)
            refuse(written.takes_set_points_span, "TAKES SET_POINTS, which it does by itself,");
        if (!written.terms.empty()) refuse(written.terms.front().span, "TERM");
        for (std::size_t i = 0; i < written.choices.size(); ++i) {
            const ast::Choice& choice = written.choices[i];
            if (!choice.bare) refuse(choice.branches.front().span, "IF");
        }
    }

    void refuse_power_up_beside(const ast::Step& zero) {
        const auto refuse = [&](Span span, const char* what) {
            report_
                .add("E096", span, fmt::format("{} cannot stand beside a step with the number 0", what),
                     fmt::format("'{}' is what power-up starts in: send it from there, or leave its AT out",
                                 zero.name.text))
                .notes.push_back({zero.name.span, "it has the number 0"});
        };
        if (program_.power_up) refuse(program_.power_up->name.span, "POWER_UP");
        if (scope_.initial_values().empty()) return;
        const Send& first = scope_.initial_values().front();
        refuse(first.span, first.set_point != 0 ? "a SET_POINT with AT" : "a value in VAR_MOTOR");
    }

    StepPlan step(const ast::Step& written, std::uint8_t number) {
        StepPlan plan;
        plan.name = written.name.text;
        plan.span = written.name.span;
        plan.number = number;
        plan.own_error = written.own_error || number == fault_;  // E081 is reported
        plan.no_helper = written.no_helper;
        plan.entry = entries_[number].statements;
        plan.takes_set_points = written.takes_set_points;
        if (written.takes_set_points) refuse_entry_that_acts(entries_[number], written);
        add_outputs(written, plan);
        add_rules(written, plan);
        for (const ast::RawTerm& term : written.terms) {
            plan.terms.push_back(raw_term(term, number));
            const int step = sequencer::step_of(plan.terms.back().bytes);
            if (step == number) continue;
            Diagnostic& d = report_.add(
                "E092", term.span,
                fmt::format("this term is for step {}, and '{}' is step {}", step, plan.name, number),
                term.symbols ? "leave its name out, or write the TERM outside of the step"
                             : fmt::format("bits 5..0 of its first byte must be 16#{:02X}, or write the TERM "
                                           "outside of the step",
                                           number));
            d.notes.push_back({plan.span, "steps are numbered in the order they stand, from 1, or by AT"});
        }
        return plan;
    }

    /// Called once per state of the step's memory; a condition is never true if it is in none of them.
    void add_rules(const ast::Step& written, StepPlan& plan) {
        plan.memory = memories_[plan.number];
        const std::size_t states = plan.memory.states();
        plan.rules_in.resize(states);
        plan.idle_in.resize(states);
        for (std::size_t state = states; state-- > 0;) {
            memory_ = &plan.memory;
            state_ = state;
            scope_.see_edges(&plan.memory.edges, state);
            plan.rules.clear();
            plan.idle.clear();
            add_choices(written, plan);
            add_fault_rule(written, plan);
            plan.rules_in[state] = plan.rules;
            plan.idle_in[state] = plan.idle;
        }
        plan.rules = plan.rules_in.back();
        plan.idle = plan.idle_in.back();
        scope_.see_edges(nullptr, 0);
    }

    void add_fault_rule(const ast::Step& written, StepPlan& plan) {
        if (written.own_error) return;
        if (fault_) {
            plan.rules.push_back(fault_rule({}));
        } else if (!program_.on_error) {
            silent_.push_back(&written);
        }
    }

    /// Once for all steps. ON ERROR EXCEPT .. is handled as any other ON condition: one that names ERROR
    /// applies to steps with OWN ERROR.
    void refuse_silent_steps() {
        if (silent_.empty()) return;
        const auto on = std::find_if(program_.on_conditions.begin(), program_.on_conditions.end(),
                                     [](const auto& written) { return names_error(written.condition); });
        const bool has_on = on != program_.on_conditions.end();
        const ast::Step& first = **std::min_element(
            silent_.begin(), silent_.end(),
            [](const ast::Step* a, const ast::Step* b) { return a->name.span.offset < b->name.span.offset; });
        std::set<std::uint32_t> places;
        for (const ast::Step* step : silent_) places.insert(step->name.span.offset);
        const std::size_t others = places.size() - 1;
        const std::string who = fmt::format("'{}'{}", first.origin ? first.origin->step : first.name.text,
                                            others == 0   ? std::string()
                                            : others == 1 ? std::string(" and another step")
                                                          : fmt::format(" and {} other steps", others));
        const std::string_view where = others == 0 ? "the step" : "each";
        Diagnostic& d = report_.add(
            "E080", first.name.span,
            fmt::format("{} {} not say what happens on ERROR", who, others == 0 ? "does" : "do"),
            has_on
                ? fmt::format("write OWN ERROR; in {}, or ON ERROR NEXT := Fault; without IN, EXCEPT or more",
                              where)
                : fmt::format("write ON ERROR NEXT := Fault; at the top, or OWN ERROR; in {}", where));
        if (has_on) d.notes.push_back({on->span, "this applies only to steps with OWN ERROR"});
    }

    /// The cases of a branch's condition, with FOR and WITHIN applied.
    Truth truth_of(const ast::Branch& branch, bool has_limit) {
        const Truth at_end = truth_of_bit(kTimerZero);
        if (!branch.condition) return has_limit ? cases_without_time(at_end) : no_error_cases();
        const Truth own = scope_.branch_truth(*branch.condition);
        if (!branch.timing || branch.timing->is_limit) return own;
        return memory_->runs(state_) ? own & at_end : Truth();
    }

    /// The cases of the ELSE that belongs to WITHIN.
    Truth cases_without_time(const Truth& at_end) const {
        const Limit limit = memory_->limit_of(state_);
        if (limit == Limit::runs) return {};
        return limit == Limit::over ? no_error_cases() : no_error_cases() & at_end;
    }

    /// ENTRY is executed in the scan that leads to the step, before the step evaluates anything.
    void refuse_entry_that_acts(const Action& entry, const ast::Step& written) {
        if (entry.sends.empty() && entry.timer_point == 0 && entry.counter_point == 0) return;
        report_
            .add("E068", entry.span,
                 fmt::format("this happens before '{}' takes set-points", written.name.text),
                 "put it into a branch of the step, or into the ENTRY of the step behind it")
            .notes.push_back({written.takes_set_points_span, "the step takes them once it is active"});
    }

    void add_outputs(const ast::Step& written, StepPlan& plan) {
        std::array<Span, 4> places{};
        warn_named_twice(written.outputs, scope_);
        for (const ast::Blinking& blinking : written.blinking) warn_named_twice(blinking.outputs, scope_);
        for (const ast::Name& name : written.outputs) {
            const auto bit = scope_.output(name);
            if (!bit) continue;
            plan.outputs |= static_cast<std::uint8_t>(1U << *bit);
            places.at(*bit) = name.span;
        }
        for (const ast::ConditionalOutput& conditional : written.conditional) {
            ConditionalOutput output;
            output.when = scope_.branch_truth(conditional.condition);
            output.condition = conditional.condition.span;
            warn_named_twice(conditional.outputs, scope_);
            for (const ast::Name& name : conditional.outputs) {
                const auto bit = scope_.output(name);
                if (!bit) continue;
                output.outputs |= static_cast<std::uint8_t>(1U << *bit);
                if ((plan.outputs >> *bit) & 1) {
                    report_
                        .add("W008", name.span, fmt::format("'{}' is on in this step anyway", name.text),
                             "remove it from one of the two OUT")
                        .notes.push_back({places.at(*bit), "switched on here"});
                }
            }
            plan.conditional.push_back(output);
        }
        // Step 0 is not entered at power-up, so its outputs need a term of their own.
        if (plan.number == kPowerUp && plan.outputs != 0)
            plan.conditional.push_back({plan.outputs, always(), {}});
    }

    /// The rules before a step's own branches, or before one of them.
    struct Earlier {
        Truth taken;
        std::vector<Rule> rules;
    };

    void add_choices(const ast::Step& written, StepPlan& plan) {
        SeenBranches seen;
        Earlier on;
        for (std::size_t i = 0; i < on_conditions_.size(); ++i) {
            if (on_conditions_[i].steps.test(plan.number))
                add_on_condition(on_conditions_[i], written.choices.size() + i, plan, seen, on);
        }
        for (std::size_t i = 0; i < written.choices.size(); ++i)
            add_choice(written.choices[i], i, plan, seen, on);
    }

    void add_on_condition(OnCondition& on, std::size_t choice, StepPlan& plan, SeenBranches& seen,
                          Earlier& earlier) {
        ActionBuilder builder(scope_);
        Action action = builder.build({on.written->next});
        if (action.next == plan.number) return;  // it is the condition's target
        on.covers_one = true;
        enter(action, *action.next);
        const Span place = on.written->condition.span;
        if (plan.memory.timer_span && depends_on(on.when, kTimerZero)) {
            report_
                .add("E073", *plan.memory.timer_span,
                     "there is one timer, and a condition for this step tests it",
                     "leave the step out of it with EXCEPT, or test something else")
                .notes.push_back({place, "the condition is here"});
        }
        Rule rule{on.when & ~earlier.taken, action, place};
        earlier.taken |= on.when;
        earlier.rules.push_back({on.when, {}, place});
        if (rule.when.none()) return;
        on.may_act = true;
        check_error_covered(place, rule, plan);
        add_rule(std::move(rule), on.when, place, choice, plan, seen);
    }

    /// Reports an ON condition that has no effect in any step, although it can be true.
    void warn_idle_conditions() {
        for (std::size_t i = 0; i < on_conditions_.size(); ++i) {
            const OnCondition& on = on_conditions_[i];
            const Span place = on.written->condition.span;
            if (on.may_act || on.when.none() || report_.has("W001", place) || report_.full()) continue;
            if (!on.covers_one) {
                report_.add("W001", place, "this condition has no effect: it applies to no step",
                            "name in IN the steps that it is to end; EXCEPT takes steps out");
                continue;
            }
            Diagnostic& d = report_.add("W001", place, "this condition never acts",
                                        "the conditions before it take every case: put it before them");
            for (std::size_t k = 0; k < i; ++k) {
                if ((on_conditions_[k].when & on.when).any())
                    d.notes.push_back({on_conditions_[k].written->condition.span, "this one comes first"});
            }
        }
    }

    void add_choice(const ast::Choice& choice, std::size_t index, StepPlan& plan, SeenBranches& seen,
                    Earlier earlier) {
        Truth& taken = earlier.taken;
        std::vector<Rule>& before = earlier.rules;
        const auto& timing = choice.branches.front().timing;
        const bool has_limit = timing && timing->is_limit;
        for (const ast::Branch& branch : choice.branches) {
            const std::size_t errors_before = report_.error_count() + scope_.faulty_names_met();
            const Truth own = truth_of(branch, has_limit);
            const bool time_sound = !branch.timing || branch.timing->is_limit || memory_->is_held();
            const bool condition_sound =
                time_sound && report_.error_count() + scope_.faulty_names_met() == errors_before;
            Rule rule{own & ~taken, branch_action(branch, plan.number), place_of(branch)};
            taken |= own;
            before.push_back({own, {}, rule.condition});
            if (is_never_taken(branch, condition_sound, rule.when, own, before)) warn_never(branch);
            if (rule.when.any() && rule.action.is_empty()) {
                plan.idle.push_back({rule.when, {}, rule.condition, own});
            } else if (rule.when.any()) {
                check_error_covered(place_of(branch), rule, plan);
                const Span place = branch.condition ? rule.condition : rule.action.span;
                add_rule(std::move(rule), own, place, index, plan, seen);
            }
        }
    }

    static Span place_of(const ast::Branch& branch) {
        if (!branch.condition) return branch.span;
        Span place = branch.condition->span;
        if (branch.timing && !branch.timing->is_limit)
            place.length = branch.timing->span.offset + branch.timing->span.length - place.offset;
        return place;
    }

    /// Final after the last of the states. Stores for the branch what warn_never() reports.
    bool is_never_taken(const ast::Branch& branch, bool sound, const Truth& when, const Truth& own,
                        const std::vector<Rule>& up_to_it) {
        Untaken& untaken = untaken_[&branch];
        untaken.is_taken = untaken.is_taken || !sound || when.any();
        if (!untaken.is_taken && untaken.contradicts_itself && own.any()) {
            untaken.contradicts_itself = false;
            untaken.taken_by = takers(own, up_to_it);
        }
        return state_ == 0 && !untaken.is_taken;
    }

    /// The branches that take its cases, each case once; only for the first kMost branches, since more are
    /// not shown.
    std::vector<Span> takers(Truth left, const std::vector<Rule>& up_to_it) {
        constexpr unsigned kMost = 1'000;
        std::vector<Span> found;
        if (takers_found_ == kMost) return found;
        ++takers_found_;
        for (std::size_t i = 0; left.any(); ++i) {
            if ((up_to_it[i].when & left).none()) continue;
            found.push_back(up_to_it[i].condition);
            left &= ~up_to_it[i].when;
        }
        return found;
    }

    void warn_never(const ast::Branch& branch) {
        const Untaken& untaken = untaken_[&branch];
        if (untaken.contradicts_itself) {
            report_.add("W001", place_of(branch), "this branch is never taken",
                        "its condition contradicts itself: correct it, or delete the branch");
            return;
        }
        const bool is_dropped = report_.full();
        Diagnostic& d = report_.add("W001", place_of(branch), "this branch is never taken",
                                    "the branches before it take every case: put it before them, or "
                                    "take it out");
        if (is_dropped) return;
        for (const Span place : untaken.taken_by) d.notes.push_back({place, "this one comes first"});
    }

    Action branch_action(const ast::Branch& branch, std::uint8_t number) {
        ActionBuilder builder(scope_);
        Action action = builder.build(branch.statements);
        const bool leaves = action.next && *action.next != number;
        if (action.next) enter(action, *action.next);
        if (leaves) {
            if (const auto marked = builder.marked()) {
                report_
                    .add("W006", *marked, "the branch leaves the step, so this happens once anyway",
                         "leave EVERY_SCAN out")
                    .notes.push_back({action.next_span, "it leaves the step here"});
            }
            return action;
        }
        const bool repeats_entry = action.next && !entries_[number].is_empty();
        if (builder.unmarked()) {
            Diagnostic& d = report_.add(
                "E060", *builder.unmarked(),
                action.next ? "the branch stays in its step, so this would happen again in every scan"
                            : "without NEXT this would happen again in every scan",
                branch.condition || action.next
                    ? "go on to another step with NEXT, or write EVERY_SCAN in front if the repetition is "
                      "meant"
                    : "write ENTRY in front: it then happens once, when the step is entered; or EVERY_SCAN "
                      "if "
                      "that is what you want");
            if (action.next) d.notes.push_back({action.next_span, "this names the step it is in already"});
            if (repeats_entry)
                d.notes.push_back({entries_[number].span, "the step's ENTRY would be repeated too"});
            if (!action.next) action = {};  // its other effects do not matter
        } else if (repeats_entry) {
            report_
                .add("E060", action.next_span,
                     "this would enter the same step in every scan, and its ENTRY would happen again each "
                     "time",
                     "to stay in the step leave NEXT out, or go on to another one")
                .notes.push_back({entries_[number].span, "the ENTRY is here"});
        }
        return action;
    }

    void check_error_covered(Span place, const Rule& rule, const StepPlan& plan) {
        if (plan.own_error || !program_.on_error || (rule.when & error_cases()).none()) return;
        report_
            .add("E082", place, fmt::format("ON ERROR covers '{}' already", plan.name),
                 "write OWN ERROR; in the step, and deal with ERROR in it")
            .notes.push_back({program_.on_error->span, "ON ERROR is here"});
    }

    /// Branches with the same effect become one rule.
    void add_rule(Rule rule, const Truth& own, Span place, std::size_t choice, StepPlan& plan,
                  SeenBranches& seen) {
        if (report_.full_of_errors()) return;
        const auto same = std::find_if(plan.rules.begin(), plan.rules.end(), [&](const Rule& earlier) {
            return earlier.action.same_effect(rule.action);
        });
        const auto number = static_cast<std::size_t>(same - plan.rules.begin());
        const bool is_said = state_ + 1 != memory_->states() && report_.has("E070", place);
        if (seen.claim(rule.when, number) && !is_said) report_contested(rule, place, choice, number, seen);
        seen.list.push_back({rule.when, rule.condition, choice, number});
        RulePart part{rule.when, rule.action, rule.condition, own};
        if (same == plan.rules.end()) {
            plan.rules.push_back(std::move(rule));
            plan.rules.back().parts.push_back(std::move(part));
            return;
        }
        if (!depends_on(same->when, kInPosBit) && depends_on(rule.when, kInPosBit))
            same->condition = rule.condition;
        same->when |= rule.when;
        same->parts.push_back(std::move(part));
    }

    void report_contested(const Rule& rule, Span place, std::size_t choice, std::size_t number,
                          const SeenBranches& seen) {
        for (const SeenBranches::Branch& earlier : seen.list) {
            if (report_.full_of_errors()) return;
            const Truth both = earlier.when & rule.when;
            if (earlier.choice == choice || earlier.rule == number || both.none()) continue;
            report_
                .add("E070", place,
                     fmt::format("this and an earlier IF can hold together: {}",
                                 example_of(both, earlier.when, rule.when, symbols_)),
                     "join them with ELSIF, or make the conditions exclude each other")
                .notes.push_back({earlier.condition, "the earlier one is here, and does something else"});
        }
    }

    /// `inside`: the enclosing step, if any.
    RawTerm raw_term(const ast::RawTerm& term, std::optional<std::uint8_t> inside) {
        RawTerm raw{{}, term.span};
        if (term.symbols) {
            raw.bytes = encode_term(*term.symbols, term.span, inside, scope_);
        } else {
            std::copy(term.bytes.begin(), term.bytes.end(), raw.bytes.begin());
        }
        return raw;
    }

    const ast::Program& program_;
    std::vector<const ast::Step*> silent_;  ///< without a word on ERROR
    Scope& scope_;
    Report& report_;
    const Symbols& symbols_;
    std::array<Action, 64> entries_;  ///< by step number
    std::optional<std::uint8_t> fault_;
    std::vector<OnCondition> on_conditions_;
    std::array<Memory, 64> memories_;  ///< by step number
    /// A branch through the states of its step's memory: its cases in the first one that has any.
    struct Untaken {
        bool is_taken = false;
        bool contradicts_itself = true;
        std::vector<Span> taken_by;
    };
    std::map<const ast::Branch*, Untaken> untaken_;
    unsigned takers_found_ = 0;       ///< branches for which they were looked for
    const Memory* memory_ = nullptr;  ///< of the present step, and its state
    std::size_t state_ = 0;
};

}  // namespace

Plan check(const ast::Program& program, Scope& scope, Report& report) {
    return Checker(program, scope, report, scope.symbols()).run();
}

}  // namespace nplc::seqc
