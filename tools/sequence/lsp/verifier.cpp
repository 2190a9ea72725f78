#include "lsp/verifier.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/course_scenario.h"
#include "analysis/story.h"
#include "report/verify_question.h"
#include "seqc/properties.h"
#include "sequencer/table.h"

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

Span span_of_property(const PropertyReading& reading, const std::string& name) {
    for (std::size_t i = 0; i < reading.properties.size(); ++i) {
        if (reading.properties[i].name == name) return reading.names[i];
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

Finding finding_of(const verify::Result& result, const Compilation& program, const PropertyReading& reading,
                   const verify::Names& names) {
    const bool is_property = result.code.empty();
    Finding finding;
    finding.code = result.code;
    finding.name = result.name;
    finding.span =
        is_property ? span_of_property(reading, result.name) : span_of_step(program, result.step.value_or(0));
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
    const PropertyReading reading = properties_of(job.sources, program.symbols);
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
        if (!silent_check) outcome.findings.push_back(finding_of(result, program, reading, names));
    }
    return outcome;
}

}  // namespace nplc::seqc::lsp
