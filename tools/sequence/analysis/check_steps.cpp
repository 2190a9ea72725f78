#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <optional>

#include "analysis/story.h"
#include "findings.h"

namespace nplc::verify {
namespace {

/// Where each step leads, and where the first course begins: step 0, and where that leads without ERROR.
struct StepGraph {
    std::array<Steps, 64> next{};
    Steps first = 1;

    explicit StepGraph(const Explorer& explorer) {
        for (const Group& group : explorer.machine().all_groups()) {
            if (explorer.first_use(group) == Explorer::kNone) continue;
            const std::uint8_t from = explorer.place(explorer.first_use(group)).step;
            const std::uint8_t to = group.outcome.next;
            next[from] |= bit_of(to);
            if (from == 0 && !group.error) first |= bit_of(to);
        }
    }
    Steps reached_from(std::uint8_t step) const {
        Steps all = bit_of(step);
        for (Steps open = all; open != 0;) {
            const auto at = static_cast<std::uint8_t>(std::countr_zero(open));
            open &= open - 1;
            open |= next[at] & ~all;
            all |= next[at];
        }
        return all;
    }
};

std::optional<Scans> course_into(const Subject& subject, std::uint8_t step) {
    for (Explorer::Node node = 0; node < subject.explorer.size(); ++node) {
        if (subject.explorer.place(node).step != step) continue;
        if (auto course = subject.courses.to(node)) return course;
    }
    return std::nullopt;
}

auto others_into(const Explorer& explorer, std::uint8_t step) {
    return [&explorer, step](const OtherCourses& courses) {
        return courses.to([&](Explorer::Node node) { return explorer.place(node).step == step; });
    };
}

/// A copy of a step is that step.
Steps without_copies(Steps steps, const Names& names) {
    Steps result = 0;
    for (; steps != 0; steps &= steps - 1) {
        const auto step = static_cast<std::uint8_t>(std::countr_zero(steps));
        result |= bit_of(step < names.copy_of.size() ? names.copy_of[step].value_or(step) : step);
    }
    return result;
}

/// The outputs that are on in every place of these steps.
std::uint8_t always_on(const Explorer& explorer, Steps steps) {
    unsigned outputs = 0xF;
    for (Explorer::Node node = 0; node < explorer.size(); ++node) {
        const Place& place = explorer.place(node);
        if ((steps & bit_of(place.step)) != 0) outputs &= place.outputs;
    }
    return static_cast<std::uint8_t>(outputs);
}

/// With an output that SET has switched on, the first step may have a copy in the group: only how it began
/// does not come back.
std::string no_way_back(const Subject& subject, Steps group, Steps first) {
    const Names& names = subject.names;
    const Steps named_first = without_copies(first, names) & ~Steps{1};
    const bool comes_back = (without_copies(group, names) & named_first) != 0;
    if (!comes_back)
        return fmt::format("steps {} lead to each other only, never back to {}", names_of(group, names),
                           names_of(first, names));
    const unsigned stays_on =
        always_on(subject.explorer, group) & ~unsigned{always_on(subject.explorer, first)};
    if (stays_on == 0)
        return fmt::format(
            "steps {} lead to each other only, and never back to {} as it was at the beginning",
            names_of(group, names), names_of(named_first, names));
    return fmt::format(
        "steps {0} lead to each other only, and none of them switches {1} off: {2} is never "
        "entered again with {1} off",
        names_of(group, names), outputs_text(static_cast<std::uint8_t>(stays_on), names),
        names_of(named_first, names));
}

void find_never_reached(const Subject& subject, std::vector<Finding>& findings) {
    const Machine& machine = subject.explorer.machine();
    const Steps begun = without_copies(subject.explorer.steps_begun(), subject.names);
    const Steps copies = ~without_copies(~Steps{0}, subject.names);
    for (std::uint8_t step = 1; step <= sequencer::kLastStep; ++step) {
        const bool is_there =
            !subject.names.steps[step].empty() || ((machine.steps_with_terms() >> step) & 1U) != 0;
        if (!is_there || ((begun | copies) & bit_of(step)) != 0) continue;
        findings.push_back(
            {"V001", step, fmt::format("no course reaches step {}", step_name(subject.names, step)), {}});
    }
}

void find_never_left(const Subject& subject, std::vector<Finding>& findings) {
    const StepGraph graph(subject.explorer);
    const Steps begun = subject.explorer.steps_begun();
    if (std::has_single_bit(begun)) return;
    Steps told = 0;
    Steps told_alone = 0;  // by the step of which they are copies
    std::vector<Steps> told_groups;
    for (std::uint8_t step = 0; step <= sequencer::kLastStep; ++step) {
        if ((begun & bit_of(step)) == 0) continue;
        const Steps group = graph.reached_from(step);
        if (group == bit_of(step)) {
            if ((told_alone & without_copies(group, subject.names)) != 0) continue;
            told_alone |= without_copies(group, subject.names);
            if (auto course = course_into(subject, step))
                findings.push_back({"V002", step,
                                    fmt::format("nothing leaves step {}", step_name(subject.names, step)),
                                    std::move(*course), others_into(subject.explorer, step)});
            continue;
        }
        if ((group & graph.first) != 0 || (told & bit_of(step)) != 0) continue;
        const Steps one = group & (~group + 1);
        const bool all_meet = graph.reached_from(static_cast<std::uint8_t>(std::countr_zero(one))) == group;
        if (!all_meet || (graph.reached_from(step) & bit_of(step)) == 0) continue;
        told |= group;
        const Steps named = without_copies(group, subject.names);
        if (std::find(told_groups.begin(), told_groups.end(), named) != told_groups.end()) continue;
        told_groups.push_back(named);
        auto course = course_into(subject, step);
        if (!course) continue;
        findings.push_back({"V003", step, no_way_back(subject, group, graph.first), std::move(*course),
                            others_into(subject.explorer, step)});
    }
}

}  // namespace

std::vector<std::uint32_t> distances_to_step(const Explorer& explorer, const EdgesBack& back,
                                             std::uint8_t step) {
    std::vector<std::uint32_t> distances(explorer.size(), kFar);
    std::vector<Explorer::Node> open;
    for (Explorer::Node node = 0; node < explorer.size(); ++node) {
        if (explorer.place(node).step != step) continue;
        distances[node] = 0;
        open.push_back(node);
    }
    for (std::size_t i = 0; i < open.size(); ++i) {
        for (const Explorer::Node from : back.to(open[i])) {
            if (distances[from] != kFar) continue;
            distances[from] = distances[open[i]] + 1;
            open.push_back(from);
        }
    }
    return distances;
}

std::optional<std::vector<CourseScan>> Courses::to(Explorer::Node node, std::vector<CourseScan> then) {
    std::optional<std::vector<CourseScan>> course;
    if (excluded_ == nullptr) {
        course = explorer_.course_to_node(node);
    } else {
        if (!walk_) {
            walk_.emplace(explorer_, excluded_);
            walk_->begin_at_power_up(0);
            walk_->all([](const Walk::Scan& scan) { scan.go_on(0); });
        }
        course = walk_->course_to_node(node, [&](Excluded::State state) {
            for (const CourseScan& scan : then)
                state = state == Excluded::kOut ? state : excluded_->next(state, scan);
            return state != Excluded::kOut;
        });
    }
    if (course) course->insert(course->end(), then.begin(), then.end());
    return course;
}

std::string names_of(Steps steps, const Names& names) {
    std::string text;
    steps = without_copies(steps, names);
    for (; steps != 0; steps &= steps - 1)
        text +=
            (text.empty() ? "" : ", ") + step_name(names, static_cast<std::uint8_t>(std::countr_zero(steps)));
    return text;
}

std::vector<Finding> check_steps(const Subject& subject) {
    std::vector<Finding> findings;
    find_never_reached(subject, findings);
    find_never_left(subject, findings);
    const std::vector<Finding> rounds = find_rounds(subject);
    findings.insert(findings.end(), rounds.begin(), rounds.end());
    return findings;
}

}  // namespace nplc::verify
