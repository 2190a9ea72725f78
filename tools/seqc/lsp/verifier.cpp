#include "lsp/verifier.h"

#include <fmt/format.h>

#include <algorithm>

#include "sequencer/table.h"
#include "syntax/lexer.h"
#include "verify/course_scenario.h"
#include "verify/story.h"
#include "views/verify_question.h"

namespace nplc::seqc::lsp {
namespace {

using verify::Severity;
using verify::Verdict;

/// Limited, since an editor's machine has other work.
constexpr std::size_t kMostStates = 1'000'000;
constexpr std::size_t kMostRelated = 20;

Span span_of_step(const Compilation& program, std::uint8_t step) {
    for (const StepOrigin& origin : program.steps) {
        if (origin.number == step && origin.span.length > 0) return origin.span;
    }
    return program.steps.empty() ? Span{} : program.steps.front().span;
}

/// Position of the name after PROPERTY.
Span span_of_property(const Compilation& program, std::string_view source, const std::string& name) {
    for (const Span& span : program.properties) {
        const std::string_view text = source.substr(span.offset, span.length);
        Report noise;
        const std::vector<Token> words = tokens_of(text, noise);
        if (words.size() > 1 && words[1].text == name)
            return {span.offset + words[1].span.offset, words[1].span.length};
    }
    return {};
}

std::vector<Note> related_of(const verify::Course& course, const Compilation& program,
                             const verify::Names& names) {
    std::vector<Note> notes;
    std::uint64_t time = 0;
    for (const verify::PlayedScan& scan : course) {
        if (scan.after.step != scan.step && notes.size() < kMostRelated) {
            notes.push_back(
                {span_of_step(program, scan.after.step),
                 fmt::format("{} ms: {} -> {}, outputs {}", time, verify::step_name(names, scan.step),
                             verify::step_name(names, scan.after.step),
                             verify::outputs_text(scan.after.outputs, names))});
        }
        time += scan.dt_ms;
    }
    return notes;
}

Finding finding_of(const verify::Result& result, const Compilation& program, std::string_view source,
                   const verify::Names& names) {
    const bool is_property = result.code.empty();
    Finding finding;
    finding.code = result.code;
    finding.name = result.name;
    finding.span = is_property ? span_of_property(program, source, result.name)
                               : span_of_step(program, result.step.value_or(0));
    const bool broken = result.verdict == Verdict::broken;
    using Level = Finding::Level;
    finding.level = result.verdict == Verdict::proved    ? Level::hint
                    : !result.allowed.empty() || !broken ? Level::information
                    : result.severity == Severity::fault ? Level::error
                                                         : Level::warning;
    const char* verdict = broken ? "broken" : result.verdict == Verdict::proved ? "proved" : "undecided";
    finding.message = is_property ? fmt::format("{}: {}", verdict, result.text) : result.reason;
    if (is_property && !result.reason.empty()) finding.message += fmt::format(" ({})", result.reason);
    if (!result.allowed.empty()) finding.message += fmt::format(" (allowed because {})", result.allowed);
    if (result.course && !result.course->empty()) {
        finding.related = related_of(*result.course, program, names);
        if (broken) finding.scenario = verify::scenario_of(result, names);
    }
    return finding;
}

}  // namespace

VerifyOutcome verify_program(const VerifyJob& job) {
    const std::string& text = job.sources.text();
    VerifyOutcome outcome{job.uri, job.version, text, 0, false, {}};
    const Compilation program = compile(job.sources);
    if (!program.ok) return outcome;
    const auto loaded = sequencer::Table::load(program.table);
    if (!loaded.ok) return outcome;
    const verify::Names names = verify_names(program.symbols);
    verify::PropertyReading reading = properties_in(program, text, names);
    if (!reading.error.empty()) {
        const auto property =
            std::find_if(program.properties.begin(), program.properties.end(), [&](Span span) {
                const std::string_view before = std::string_view(text).substr(0, span.offset + span.length);
                return static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1 >=
                       reading.line;
            });
        const Span span = property == program.properties.end() ? Span{} : *property;
        outcome.findings.push_back({span, "", "property", reading.error, Finding::Level::error, {}, {}});
        return outcome;
    }
    verify::Options options;
    options.order_time = order_times(program.symbols.drive != nullptr);
    options.most_states = kMostStates;
    options.assumptions = reading.assumptions;
    options.allowances = allowances_in(program);
    if (verify::contradict(options.assumptions)) return outcome;
    const verify::Report report = verify::verify(loaded.table, names, reading.properties, options);
    outcome.states = report.states;
    outcome.complete = report.complete;
    for (const verify::Result& result : report.results) {
        const bool silent_check = !result.code.empty() && result.verdict == Verdict::proved;
        if (!silent_check) outcome.findings.push_back(finding_of(result, program, text, names));
    }
    return outcome;
}

}  // namespace nplc::seqc::lsp
