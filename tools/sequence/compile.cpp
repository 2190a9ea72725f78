#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <unordered_map>

#include "compiler/checker.h"
#include "compiler/claims.h"
#include "compiler/copies.h"
#include "compiler/group_outputs.h"
#include "compiler/helper_steps.h"
#include "compiler/oversights.h"
#include "compiler/scope.h"
#include "compiler/sequences.h"
#include "compiler/set_points.h"
#include "compiler/unused.h"
#include "compiler/written.h"
#include "language/lexer.h"
#include "language/names.h"
#include "language/parser.h"
#include "lowering/lower.h"
#include "lowering/set_points.h"
#include "seqc/seqc.h"

namespace nplc::seqc {
namespace {

std::vector<std::uint8_t> outputs_of_steps(const Plan& plan) {
    std::vector<std::uint8_t> outputs(sequencer::kLastStep + 1U);
    for (const StepPlan& step : plan.steps) outputs[step.number] = step.outputs;
    return outputs;
}

void emit(const LoweredTerm& term, Compilation& result) {
    result.table.insert(result.table.end(), term.bytes.begin(), term.bytes.end());
    result.origins.push_back({term.span});
}

void emit_all(const std::vector<LoweredTerm>& terms, const Plan& plan, Compilation& result) {
    for (const LoweredTerm& term : terms) emit(term, result);
    for (const RawTerm& raw : plan.terms) emit({raw.bytes, raw.span}, result);
    if (plan.terms.empty() || !sequencer::is_end(plan.terms.back().bytes)) {
        emit({{sequencer::kEndOfTable}, {}}, result);
    }
}

/// Lower bound: each order takes a term, and a branch without orders also takes one; branches may share them.
std::size_t fewest_terms(const Plan& plan) {
    std::size_t sum = 0;
    for (const StepPlan& step : plan.steps) {
        std::size_t most = 0;
        for (const Rule& rule : step.rules) most = std::max({most, std::size_t{1}, rule.action.sends.size()});
        sum += most + step.terms.size();
    }
    return sum;
}

/// Reported before the terms are generated, which would take long.
void check_fewest_terms(const Plan& plan, Span span, Report& report) {
    const std::size_t fewest = fewest_terms(plan);
    std::size_t written = 0;
    for (const StepPlan& step : plan.steps) written += step.terms.size();
    if (fewest == written || fewest < kTermsEverywhere) return;
    report.add(
        "E086", span,
        fmt::format("at least {} terms: a gateway need not hold more than {}", fewest + 1, kTermsEverywhere),
        "simplify conditions or join steps");
}

/// Includes the end term. The number of TERMs alone is not limited, since such a table exists already.
void check_length(std::size_t in_steps, const Plan& plan, Span span, Report& report) {
    const bool has_end = !plan.terms.empty() && sequencer::is_end(plan.terms.back().bytes);
    const std::size_t count = in_steps + plan.terms.size() + (has_end ? 0 : 1);
    if (count <= kTermsEverywhere) return;
    std::size_t written = 0;
    for (const StepPlan& step : plan.steps) written += step.terms.size();
    const std::string message =
        fmt::format("{} terms: a gateway need not hold more than {}", count, kTermsEverywhere);
    if (written == in_steps) {
        report.add("W010", span, message, "make sure that yours does");
    } else {
        report.add("E086", span, message, "simplify conditions or join steps");
    }
}

/// Whether a diagnostic is still valid if whole statements are missing after a syntax error.
bool stands_without_the_rest(const Diagnostic& d) {
    const Phase phase = find_code(d.code)->phase;
    return d.severity == Severity::error &&
           (phase == Phase::names || phase == Phase::motor || phase == Phase::commands);
}

/// A gateway starts only after its motor has answered, so every program needs MOTOR.
void check_motor_is_named(const ast::Program& program, const Plan& plan, Report& report) {
    if (program.motor || program.motor_missing || plan.steps.empty()) return;
    report.add("W026", program.name.span,
               "the program names no MOTOR, but a gateway starts only when a motor answers",
               "write MOTOR MAC140; or the name of your motor");
}

/// Whether ALLOW in the step or in POWER_UP that contains the finding switches it off.
bool is_allowed(const ast::Program& program, const Diagnostic& d) {
    const auto allows = [&](const ast::Step& step) {
        return std::any_of(
            step.allowances.begin(), step.allowances.end(), [&](const ast::Allowance& allowance) {
                if (upper(allowance.code.text) != d.code) return false;
                return std::any_of(
                    program.blocks.begin(), program.blocks.end(), [&](const ast::Block& block) {
                        const auto holds = [&](Span span) {
                            return span.offset >= block.span.offset &&
                                   span.offset < block.span.offset + block.span.length;
                        };
                        return (block.end_word == "END_STEP" || block.end_word == "END_POWER_UP") &&
                               holds(d.span) && holds(allowance.code.span);
                    });
            });
    };
    return is_advice(d.code) && (std::any_of(program.steps.begin(), program.steps.end(), allows) ||
                                 (program.power_up && allows(*program.power_up)));
}

void collect_allowances(const ast::Program& program, const Plan& plan, Compilation& result) {
    const auto collect = [&](const ast::Step& step) {
        for (const ast::Allowance& allowance : step.allowances) {
            if (is_advice(upper(allowance.code.text))) continue;
            for (const StepPlan& planned : plan.steps) {
                if (same_name(planned.name, step.name.text) ||
                    (planned.is_copy && planned.span == step.name.span))
                    result.allowances.push_back(
                        {planned.number, upper(allowance.code.text), std::string(allowance.reason.text)});
            }
        }
    };
    for (const ast::Step& step : program.steps) collect(step);
    if (program.power_up) collect(*program.power_up);
}

/// Names the origin of the steps of a SEQUENCE; steps of a later call are copies of the first one's.
void name_origins(const ast::Program& program, const Scope& scope, Compilation& result) {
    std::unordered_map<std::string, std::uint8_t> numbers;  // the first of a name, in upper case
    for (std::size_t i = 0; i < scope.steps().size(); ++i) {
        if (scope.number_of(i) <= kLastNamed)
            numbers.try_emplace(upper(scope.steps()[i]->name.text), scope.number_of(i));
    }
    const auto number_of = [&](std::string_view name) -> std::optional<std::uint8_t> {
        const auto found = numbers.find(upper(name));
        return found == numbers.end() ? std::nullopt : std::optional(found->second);
    };
    for (const ast::Step& step : program.steps) {
        const auto number = step.origin ? number_of(step.name.text) : std::nullopt;
        if (!number) continue;
        result.symbols.made_for[*number] = fmt::format("of SEQUENCE {}, goes on at '{}'",
                                                       step.origin->sequence.text, step.origin->back.text);
        if (!step.origin->first.empty()) result.symbols.copy_of[*number] = number_of(step.origin->first);
    }
}

void note_limits(const Plan& plan, Compilation& result) {
    for (const StepPlan& step : plan.steps) {
        const bool is_limit = step.memory.limit != 0 || step.memory.blink_for != 0;
        if (is_limit && step.number <= kLastNamed)
            result.symbols.timer_is_limit |= std::uint64_t{1} << step.number;
    }
}

void add_copies_to_groups(Symbols& symbols) {
    for (StepGroup& group : symbols.groups) {
        for (std::uint8_t step = 0; step < symbols.steps.size(); ++step) {
            const std::optional<std::uint8_t> of = symbols.copy_of[step];
            if (of && ((group.steps >> *of) & 1U) != 0) group.steps |= std::uint64_t{1} << step;
        }
    }
}

std::vector<LoweredTerm> lower_all(const Plan& plan, const std::vector<DeclaredSetPoint>& points,
                                   Symbols& symbols, Report& checks) {
    const std::vector<std::uint8_t> outputs = outputs_of_steps(plan);
    const SetPointMarks marks(plan, points);
    std::vector<LoweredTerm> terms;
    for (const StepPlan& step : marks.plan().steps) {
        const std::vector<LoweredTerm> own = lower(step, outputs, checks);
        terms.insert(terms.end(), own.begin(), own.end());
    }
    std::vector<set_points::SetPoint> placed;
    marks.place(terms, placed);
    symbols.set_points = record_of(plan, points, placed);
    return terms;
}

/// Tracks the motor through the steps.
void check_motion(const ast::Program& program, const Plan& plan, Scope& scope, const Sources& sources,
                  Compilation& result, Report& checks) {
    const Symbols& symbols = result.symbols;
    check_motor_state(plan, symbols, sources.text(), checks);
    check_relative_moves(plan, result.roundings, checks);
    check_replaced_moves(plan, checks);
    check_invisible_limits(plan, symbols.motor, checks);
    check_home_mode(plan, symbols.motor, checks);
    check_lasting_selections(plan, symbols, sources.text(), checks);
    check_standing_in_position(plan, checks);
    if (symbols.drive == nullptr) check_lasting_motion(plan, sources.text(), checks);
    check_known_places(plan, symbols, scope.set_points(), sources.text(), checks);
    check_zero_speed(plan, symbols, scope.set_points(), checks);
    check_restart(program, plan, scope, checks);
    check_guards(program, plan, scope, checks);
    check_arrivals(program, plan, checks);
    if (symbols.drive == nullptr) check_moved_away(plan, checks);
    if (symbols.drive == nullptr) return;
    check_drive_motion(plan, *symbols.drive, scope.set_points(), checks, result.roundings);
    check_drive_registers(plan, *symbols.drive, checks);
}

void merge(Report& report, Report& checks, bool all) {
    if (checks.has_more()) report.note_more();
    for (Diagnostic& d : checks.take()) {
        if (all || stands_without_the_rest(d)) report.add(std::move(d));
    }
}

}  // namespace

Compilation compile(std::string_view source) {
    return compile(Sources({{}, std::string(source)}));
}

Compilation compile(const Sources& sources) {
    Compilation result;
    Report report;
    if (sources.text().size() > kLongestSource) {
        report.add("E001", {}, "the file is larger than 16 MiB: this is no program",
                   "name the program's text, a .seq file");
        result.diagnostics = report.take();
        return result;
    }
    for (const Diagnostic& problem : sources.problems()) report.add(problem);
    ast::Program program = Parser(sources, report).parse();
    const bool syntax_sound = !report.has_errors();
    Report checks;
    expand_sequences(program, checks);
    Scope scope(program, sources.text(), checks, result);
    spread_outputs(program, scope);
    Plan plan = check(program, scope, checks);
    const SequenceCalls calls(program, sources);
    if (!plan.steps.empty() && plan.steps.front().number == 0)
        result.symbols.steps[0] = plan.steps.front().name;
    if (syntax_sound && !checks.has_errors()) check_shared_timer(plan, calls, checks);
    if (syntax_sound && !checks.has_errors()) check_left_on(program, plan, result.symbols, checks);
    if (syntax_sound && !checks.has_errors()) make_copies(plan, calls, result, checks);
    if (syntax_sound && !checks.has_errors()) make_helper_steps(plan, result, checks);
    name_origins(program, scope, result);
    add_copies_to_groups(result.symbols);
    const bool is_whole = syntax_sound && !checks.has_errors();
    Report claims;
    resolve_claims(program, scope, is_whole, claims);
    for (const StepPlan& step : plan.steps) result.steps.push_back({step.number, step.span, step.outputs});
    result.written = written_of(program, plan, scope.initial_values());
    collect_allowances(program, plan, result);
    note_limits(plan, result);
    std::sort(result.steps.begin(), result.steps.end(),
              [](const StepOrigin& a, const StepOrigin& b) { return a.number < b.number; });
    if (syntax_sound && !checks.has_errors()) check_fewest_terms(plan, program.name.span, checks);
    if (syntax_sound && !checks.has_errors()) check_motion(program, plan, scope, sources, result, checks);
    std::vector<LoweredTerm> terms;
    if (syntax_sound && !checks.has_errors()) {
        terms = lower_all(plan, scope.set_points(), result.symbols, checks);
        check_set_points(plan, scope.set_points(), result.symbols, checks);
    }
    if (syntax_sound && !checks.has_errors()) {
        check_oversights(program, plan, result.symbols, scope.set_points(), checks);
        check_unused(program, plan, sources, result.symbols, checks);
        check_motor_is_named(program, plan, checks);
    }
    if (!checks.has_errors()) check_length(terms.size(), plan, program.name.span, checks);
    checks.drop([&](const Diagnostic& d) { return is_allowed(program, d); });
    merge(report, checks, syntax_sound);
    merge(report, claims, true);
    result.ok = !report.has_errors();
    if (result.ok) emit_all(terms, plan, result);
    result.more_diagnostics = report.has_more();
    result.diagnostics = report.take();
    return result;
}

}  // namespace nplc::seqc
