#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "meaning/checker.h"
#include "meaning/scope.h"
#include "seqc/seqc.h"
#include "syntax/lexer.h"
#include "syntax/parser.h"
#include "terms/lower.h"

namespace nplc::seqc {
namespace {

std::vector<std::uint8_t> outputs_of_steps(const Plan& plan) {
    std::vector<std::uint8_t> outputs;
    for (const StepPlan& step : plan.steps) outputs.push_back(step.outputs);
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

/// After a syntax error whole statements are missing, so only what names and values say is worth reporting.
void merge(Report& report, Report& checks, bool all) {
    if (checks.has_more()) report.note_more();
    for (Diagnostic& d : checks.take()) {
        if (all || (d.code >= "E020" && d.code <= "E059")) report.add(std::move(d));
    }
}

}  // namespace

Compilation compile(std::string_view source) {
    Compilation result;
    Report report;
    if (source.size() > kLongestSource) {
        report.error("E001", {}, "the file is larger than 16 MiB: this is no program",
                     "name the program's text, a .seq file");
        result.diagnostics = report.take();
        return result;
    }
    const ast::Program program = Parser(source, tokens_of(source, report), report).parse();
    const bool syntax_sound = !report.has_errors();
    Report checks;
    Scope scope(program, source, checks, result);
    const Plan plan = check(program, scope, checks);
    if (!plan.steps.empty()) result.symbols.steps[0] = plan.steps.front().name;
    for (const StepPlan& step : plan.steps) result.steps.push_back({step.number, step.span, step.outputs});
    if (syntax_sound && !checks.has_errors()) {
        check_motor_state(plan, result.symbols.motor, checks);
        check_invisible_limits(plan, result.symbols.motor, checks);
    }
    std::vector<LoweredTerm> terms;
    if (syntax_sound && !checks.has_errors()) {
        const std::vector<std::uint8_t> outputs = outputs_of_steps(plan);
        for (const StepPlan& step : plan.steps) {
            const std::vector<LoweredTerm> own = lower(step, outputs, checks);
            terms.insert(terms.end(), own.begin(), own.end());
        }
    }
    if (!checks.has_errors() && terms.size() + plan.terms.size() >= kTermsEverywhere) {
        const std::string message = fmt::format("{} terms: a gateway need not hold more than {}",
                                                terms.size() + plan.terms.size() + 1, kTermsEverywhere);
        if (plan.steps.empty()) {
            checks.warning("W010", program.name.span, message, "make sure that yours does");
        } else {
            checks.error("E086", program.name.span, message, "simplify conditions or join steps");
        }
    }
    merge(report, checks, syntax_sound);
    result.ok = !report.has_errors();
    if (result.ok) emit_all(terms, plan, result);
    result.more_diagnostics = report.has_more();
    result.diagnostics = report.take();
    return result;
}

}  // namespace nplc::seqc
