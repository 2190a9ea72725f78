#include "analysis/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "analysis/story.h"
#include "decider.h"
#include "findings.h"
#include "monitor.h"
#include "vacuous.h"

namespace nplc::verify {
namespace {

using Answer = Decider::Answer;

Target target_of(const Property& property) {
    switch (property.form) {
        case Form::always:
            return {.condition = &property.condition, .negated = true};
        case Form::whenever:
            return {.condition = &property.condition, .without = &property.then};
        case Form::after_possible:
            return {.condition = &property.condition, .from = &property.then};
        default:
            return {.condition = &property.condition};
    }
}

const char* reason_of(const Property& property) {
    switch (property.form) {
        case Form::never:
            return property.is_implied
                       ? "at the end of this course WHENEVER's condition holds, and THEN's does not"
                       : "its condition holds at the end of this course";
        case Form::always:
            return "its condition does not hold at the end of this course";
        case Form::reachable:
            return "no course leads to such a scan";
        case Form::always_possible:
        case Form::after_possible:
            return "from the end of this course no way leads there any more";
        case Form::whenever:
            return "THEN's condition has not held in time when this course ends";
        case Form::never_while:
            return property.text.starts_with("WHENEVER")
                       ? "at the end of this course WHENEVER's condition has held for that time, and THEN's "
                         "does not hold"
                       : "its condition holds at the end of this course, and WHILE's has held for that time";
        case Form::only_after:
            return "it holds at the end of this course, and AFTER's condition never held before";
        case Form::only_after_both:
            return "it holds at the end of this course, and these two never held one after the other before";
        case Form::only_from:
            return "it holds at the end of this course, and FROM's condition never held when a scan began";
        case Form::stays:
            return "at the end of this course its condition has not stayed as required";
        case Form::changes_only_in:
            return "it changes at the end of this course";
        case Form::scan_ends:
            return "the last scan of this course begins there and ends elsewhere";
        case Form::followed_by:
            return "THEN's condition does not hold at the end of this course";
    }
    return "";
}

/// Under `any` the next scan may come after any time: a deadline is missed as soon as it begins.
void make_late(Course& course, std::uint32_t within_ms) {
    course.back().begins = true;
    course.back().dt_ms = within_ms + 1;
}

constexpr const char* kWithSome =
    "with some values of the ranges it is; whether it is with all of them was not found";

void keep(Result& result, std::optional<Played> played) {
    if (!played) return;
    result.course = std::move(played->course);
    result.presets = std::move(played->presets);
}

Result judged(Decider& decider, const Property& property, std::size_t target, Assume assume) {
    Result result{.name = property.name, .text = property.text, .time_ms = property.within_ms};
    const bool late = property.form == Form::whenever;
    const bool possible = property.form == Form::always_possible || property.form == Form::after_possible;
    const bool timed = property.form == Form::never_while || (late && assume == Assume::driver);
    Decider::Finding finding = possible                       ? decider.stuck_outside(target)
                               : timed                        ? decider.missed_deadline(property)
                               : is_remembered(property.form) ? decider.remembered(property)
                                                              : decider.scan_of_target(target);
    if (finding.answer == Answer::unknown) {
        result.reason = std::move(finding.why);
        result.conflict = std::move(finding.conflict);
        return result;
    }
    const bool wanted = property.form == Form::reachable;
    const bool can_be = finding.answer == Answer::can_be;
    result.verdict = can_be == wanted ? Verdict::proved : Verdict::broken;
    if (result.verdict == Verdict::broken) result.reason = reason_of(property);
    if (result.verdict == Verdict::proved && wanted && !decider.is_reached_with_all(target)) {
        result.verdict = Verdict::undecided;
        result.reason = kWithSome;
    }
    keep(result, std::move(finding.played));
    result.is_late = late && result.verdict == Verdict::broken;
    if (late && result.course && assume == Assume::any) make_late(*result.course, property.within_ms);
    return result;
}

/// Finds courses for the findings of the checks. What one learns of courses that cannot be holds for all;
/// each has its own work.
class CheckedCourses {
  public:
    explicit CheckedCourses(const Decider& decider)
        : decider_(decider), explorer_(decider.coarse()), excluded_(explorer_) {}

    /// The finding's own course, or another that shows the same.
    Decider::Finding of(const Finding& finding) {
        excluded_.begin_question();
        const auto next = [&, is_first = true](Excluded& excluded) mutable -> std::optional<Way> {
            if (std::exchange(is_first, false)) return Way{.scans = finding.way};
            auto scans = finding.other(OtherCourses(explorer_, excluded, distances_to(finding.step)));
            if (!scans) return std::nullopt;
            return Way{.scans = std::move(*scans)};
        };
        return decider_.tried(excluded_, next);
    }

  private:
    const std::vector<std::uint32_t>& distances_to(std::uint8_t step) {
        if (!back_) back_.emplace(explorer_.edges(), explorer_.size());
        std::vector<std::uint32_t>& distances = distances_[step];
        if (distances.empty()) distances = distances_to_step(explorer_, *back_, step);
        return distances;
    }

    const Decider& decider_;
    const Explorer& explorer_;
    Excluded excluded_;
    std::optional<EdgesBack> back_;
    std::array<std::vector<std::uint32_t>, 64> distances_;  ///< by step, once they are asked for
};

Result result_of(const Check& check, const Finding& finding, const Names& names, const Options& options,
                 CheckedCourses& courses) {
    Result result{.name = fmt::format("{}.{}", check.name, step_name(names, finding.step)),
                  .code = std::string(check.code),
                  .step = finding.step,
                  .text = std::string(check.text),
                  .verdict = Verdict::broken,
                  .severity = check.severity,
                  .reason = finding.reason};
    for (const Allowance& allowance : options.allowances) {
        if (allowance.step != finding.step || allowance.code != check.code) continue;
        result.allowed = allowance.reason;
        result.severity = Severity::advice;
    }
    if (!finding.way.empty()) {
        Decider::Finding shown = courses.of(finding);
        keep(result, std::move(shown.played));
        if (!result.course) {
            result.verdict = Verdict::undecided;
            result.reason += fmt::format("; {}", shown.why);
            result.conflict = std::move(shown.conflict);
        }
    }
    return result;
}

/// Where ERROR lasts forever no way leads out of a fault step, or the step is entered again: that is one
/// mistake.
void drop_what_errors_explain(std::vector<Finding>& findings) {
    std::uint64_t steps = 0;
    for (const Finding& finding : findings) {
        if (finding.code == "V004" || finding.code == "V005") steps |= std::uint64_t{1} << finding.step;
    }
    std::erase_if(findings, [&](const Finding& finding) {
        const bool is_round_in_error =
            finding.code == "V013" && (finding.way.back().images & images_with_bit(7)).any();
        const bool follows = finding.code == "V002" || finding.code == "V003" || is_round_in_error;
        return follows && ((steps >> finding.step) & 1U) != 0;
    });
}

/// A result for each finding, and one for each check without.
void judge_checks(const Decider& decider, const Names& names, const Options& options,
                  std::vector<Result>& results) {
    const Explorer& explorer = decider.coarse();
    std::vector<Finding> findings;
    if (explorer.has_all_edges()) {
        Courses courses(explorer);
        for (auto* const check : {&check_steps, &check_errors, &check_zeros, &check_motor}) {
            for (Finding& finding : check({explorer, names, courses, options.may_be_zero}))
                findings.push_back(std::move(finding));
        }
    }
    drop_what_errors_explain(findings);
    CheckedCourses shown(decider);
    for (const Check& check : checks()) {
        const std::size_t before = results.size();
        for (const Finding& finding : findings) {
            if (finding.code == check.code)
                results.push_back(result_of(check, finding, names, options, shown));
        }
        if (results.size() > before) continue;
        results.push_back({.name = std::string(check.name),
                           .code = std::string(check.code),
                           .text = std::string(check.text),
                           .verdict = explorer.has_all_edges() ? Verdict::proved : Verdict::undecided,
                           .severity = check.severity,
                           .reason = explorer.has_all_edges() ? "" : out_of_bounds(explorer)});
    }
}

ImageSet permitted_by(const std::vector<Assumption>& assumptions) {
    ImageSet images = ~ImageSet{};
    for (const Assumption& assumption : assumptions) images &= ~images_where(assumption.never, {});
    return images;
}

/// 0: no limit.
std::uint32_t move_ms_of(const std::vector<Assumption>& assumptions) {
    std::uint32_t least = 0;
    for (const Assumption& assumption : assumptions) {
        if (assumption.move_ms != 0 && (least == 0 || assumption.move_ms < least)) least = assumption.move_ms;
    }
    return least;
}

/// `any` does not model the commands' effects on the motor: checks use what the gateway and a motor can do.
void judge_checks_of_driver(const sequencer::Table& table, const Names& names, const Options& options,
                            std::vector<Result>& results) {
    Options driver = options;
    driver.assume = Assume::driver;
    const Machine machine(table, driver.assume, driver.order_time, permitted_by(options.assumptions), false,
                          move_ms_of(options.assumptions), options.ranges);
    judge_checks(Decider(table, machine, driver, {}), names, driver, results);
}

/// `subject` is the target of what the property is about.
void note_vacuous(Result& result, const Explorer& explorer, const Property& property, std::size_t subject) {
    const std::string why = why_vacuous(explorer, property, explorer.hit(subject));
    if (why.empty()) return;
    result.vacuous = true;
    result.reason = "but it says nothing: " + why;
}

bool sees_error(const Course& course) {
    return std::any_of(course.begin(), course.end(),
                       [](const PlayedScan& scan) { return (scan.image & sequencer::kError) != 0; });
}

/// A proof of what is possible counts ways on which the motor gets an ERROR.
void note_only_by_error(Result& result, const Decider& decider, const Property& property, std::size_t target,
                        const Names& names) {
    if (property.form == Form::reachable) {
        if (result.course && !sees_error(*result.course)) return;  // which is such a course
        if (!decider.is_reached_only_by_error(target)) return;
        result.reason = "but only by way of ERROR: no course without one leads to such a scan";
    } else if (property.form == Form::always_possible || property.form == Form::after_possible) {
        const std::optional<Played> after = decider.course_to_only_by_error(target);
        if (!after) return;
        result.reason = fmt::format(
            "but only by way of ERROR: from step {} nothing leads there unless the motor gets one",
            step_name(names, after->course.back().after.step));
    } else {
        return;
    }
    result.only_by_error = true;
}

bool name_moving(const std::vector<Property>& properties) {
    return std::any_of(properties.begin(), properties.end(), [](const Property& property) {
        return names_moving(property.condition) || names_moving(property.then) ||
               names_moving(property.third);
    });
}

}  // namespace

bool contradict(const std::vector<Assumption>& assumptions) {
    return permitted_by(assumptions).none();
}

Report verify(const sequencer::Table& table, const Names& names, const std::vector<Property>& properties,
              const Options& options) {
    const Machine machine(table, options.assume, options.order_time, permitted_by(options.assumptions),
                          name_moving(properties), move_ms_of(options.assumptions), options.ranges);
    std::vector<Target> targets;
    targets.reserve(2 * properties.size());
    for (const Property& property : properties) targets.push_back(target_of(property));
    for (const Property& property : properties) targets.push_back(subject_of(property));
    Report report;
    if (options.checks && options.assume == Assume::any)
        judge_checks_of_driver(table, names, options, report.results);
    Decider decider(table, machine, options, std::move(targets));
    report.assumptions = options.assumptions;
    report.states = decider.coarse().size();
    report.complete = decider.coarse().complete();
    for (std::uint8_t step = 1; step <= sequencer::kLastStep; ++step) {
        const bool is_there = !names.steps[step].empty() || ((machine.steps_with_terms() >> step) & 1U) != 0;
        if (report.complete && is_there && ((decider.coarse().steps_begun() >> step) & 1U) == 0)
            report.unreachable.push_back(step);
    }
    if (options.checks && options.assume == Assume::driver)
        judge_checks(decider, names, options, report.results);
    for (std::size_t i = 0; i < properties.size(); ++i) {
        Result& result = report.results.emplace_back(judged(decider, properties[i], i, options.assume));
        if (result.verdict != Verdict::proved) continue;
        note_vacuous(result, decider.coarse(), properties[i], properties.size() + i);
        if (!result.vacuous) note_only_by_error(result, decider, properties[i], i, names);
    }
    return report;
}

}  // namespace nplc::verify
