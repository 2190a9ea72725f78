#include "verify/verify.h"

#include <fmt/format.h>

#include "decider.h"

namespace nplc::verify {
namespace {

using Answer = Decider::Answer;

Target target_of(const Property& property) {
    switch (property.form) {
        case Form::always:
            return {.condition = &property.condition, .negated = true};
        case Form::whenever:
            return {.condition = &property.condition, .without = &property.then};
        case Form::never:
        case Form::reachable:
        case Form::always_possible:
            break;
    }
    return {.condition = &property.condition};
}

const char* reason_of(Form form) {
    switch (form) {
        case Form::never:
            return "it holds after the last scan";
        case Form::always:
            return "it does not hold after the last scan";
        case Form::reachable:
            return "no course leads to such a scan";
        case Form::always_possible:
            return "no course leads there any more from the state after the last scan";
        case Form::whenever:
            return "THEN's condition did not hold in time";
    }
    return "";
}

/// Under `any` the next scan may come after any time: a deadline is missed as soon as it begins.
void make_late(Course& course, std::uint32_t within_ms) {
    course.back().dt_ms = within_ms + 1;
}

Result judged(Decider& decider, const Property& property, std::size_t target, Assume assume) {
    Result result{.name = property.name, .code = {}, .text = property.text, .reason = {}, .course = {}};
    const bool late = property.form == Form::whenever;
    Decider::Finding finding = property.form == Form::always_possible ? decider.stuck_outside(target)
                               : late && assume == Assume::driver     ? decider.missed_deadline(property)
                                                                      : decider.scan_of_target(target);
    if (finding.answer == Answer::unknown) {
        result.reason = std::move(finding.why);
        return result;
    }
    const bool wanted = property.form == Form::reachable;
    const bool can_be = finding.answer == Answer::can_be;
    result.verdict = can_be == wanted ? Verdict::proved : Verdict::broken;
    if (result.verdict == Verdict::broken) result.reason = reason_of(property.form);
    result.course = std::move(finding.course);
    if (late && result.course && assume == Assume::any) make_late(*result.course, property.within_ms);
    return result;
}

}  // namespace

Report verify(const sequencer::Table& table, const Names& names, const std::vector<Property>& properties,
              const Options& options) {
    const Machine machine(table, options.assume, options.order_time);
    std::vector<Target> targets;
    for (const Property& property : properties) targets.push_back(target_of(property));
    Decider decider(table, machine, options, std::move(targets));

    Report report;
    report.states = decider.coarse().size();
    report.complete = decider.coarse().complete();
    for (std::uint8_t step = 1; step <= sequencer::kLastStep; ++step) {
        const bool is_there = !names.steps[step].empty() || ((machine.steps_with_terms() >> step) & 1U) != 0;
        if (report.complete && is_there && ((decider.coarse().steps_begun() >> step) & 1U) == 0)
            report.unreachable.push_back(step);
    }
    for (std::size_t i = 0; i < properties.size(); ++i)
        report.results.push_back(judged(decider, properties[i], i, options.assume));
    return report;
}

}  // namespace nplc::verify
