#include <fmt/format.h>

#include <array>
#include <set>
#include <utility>

#include "findings.h"
#include "verify/story.h"
#include "walk.h"

namespace nplc::verify {
namespace {

/// V007: a zero that is waited for and was never set, or already led on from another step.
std::vector<Finding> find_stale(const Subject& subject, const Sensitivity& sensitivity, bool timer) {
    std::vector<Finding> findings;
    std::array<bool, 63> told{};
    Walk walk(subject.explorer);
    walk.all([&](const Explorer::Edge& edge, const ImageSet& images, std::uint16_t is_set, const auto& go_on,
                 const auto& show) {
        const Place here = subject.explorer.place(edge.from);
        const sequencer::Pending& pending = subject.explorer.group_of(edge).pending;
        const bool is_zero = timer ? !here.runs : here.counter == 0;
        const ImageSet decided = !is_zero ? ImageSet{}
                                 : timer  ? images & sensitivity.to_timer(here.step, here.counter == 0)
                                          : images & sensitivity.to_counter(here.step, !here.runs);
        if (is_set == 0 && decided.any() && !told[here.step]) {
            told[here.step] = true;
            findings.push_back(
                {"V007", here.step,
                 fmt::format("step {} waits for {}.Q, and the {} was not set since power-up or since it last "
                             "led to another step: it goes on at once",
                             step_name(subject.names, here.step), timer ? "TIMER" : "COUNTER",
                             timer ? "timer" : "counter"),
                 show(decided)});
        }
        const bool sets = timer ? pending.timer_preset != 0
                                : pending.counter_preset != 0 || (pending.output_byte & 0x40U) != 0;
        const bool leaves = pending.next_step != sequencer::kNoSwitch && pending.next_step != here.step;
        if (sets) return go_on(images, 1);
        if (!leaves) return go_on(images, is_set);
        go_on(images & ~decided, is_set);
        go_on(decided, 0);
    });
    return findings;
}

/// Steps that a timer at zero leads to where a running one does not.
std::uint64_t led_to(const Machine& machine, const Sensitivity& sensitivity, std::uint8_t step) {
    std::uint64_t steps = 0;
    for (const bool counter_zero : {false, true}) {
        const auto row = machine.groups(step, true, counter_zero);
        for (const Group& group : row) {
            if ((group.images & sensitivity.to_timer(step, counter_zero)).any())
                steps |= std::uint64_t{1} << group.pending.next_step;
        }
    }
    return steps;
}

/// V008: a timer that one step was to wait for and that another waits for while it still runs.
std::vector<Finding> find_other_purpose(const Subject& subject, const Sensitivity& sensitivity) {
    constexpr std::uint16_t kNone = 0;
    constexpr std::uint16_t kUnused = 1;
    constexpr std::uint16_t kFirstUser = 2;
    std::array<std::uint64_t, 63> leads_to{};
    for (std::uint8_t step = 0; step <= sequencer::kLastStep; ++step)
        leads_to[step] = led_to(subject.explorer.machine(), sensitivity, step);
    std::vector<Finding> findings;
    std::set<std::pair<unsigned, unsigned>> told;
    Walk walk(subject.explorer);
    walk.all([&](const Explorer::Edge& edge, const ImageSet& images, std::uint16_t user, const auto& go_on,
                 const auto& show) {
        const Place here = subject.explorer.place(edge.from);
        if (!here.runs) user = kNone;
        if (user != kNone && leads_to[here.step] != 0) {
            if (user == kUnused) user = static_cast<std::uint16_t>(kFirstUser + here.step);
            const auto first = static_cast<std::uint8_t>(user - kFirstUser);
            if (leads_to[first] != leads_to[here.step] && told.emplace(first, here.step).second) {
                findings.push_back(
                    {"V008", here.step,
                     fmt::format("the timer that step {} was to wait for still runs in step {}, which goes "
                                 "elsewhere when it ends",
                                 step_name(subject.names, first), step_name(subject.names, here.step)),
                     show(images)});
            }
        }
        go_on(images, subject.explorer.group_of(edge).pending.timer_preset != 0 ? kUnused : user);
    });
    return findings;
}

}  // namespace

std::vector<Finding> check_zeros(const Subject& subject) {
    const Sensitivity sensitivity(subject.explorer.machine());
    std::vector<Finding> findings = find_stale(subject, sensitivity, true);
    for (const Finding& finding : find_stale(subject, sensitivity, false)) findings.push_back(finding);
    for (const Finding& finding : find_other_purpose(subject, sensitivity)) findings.push_back(finding);
    return findings;
}

}  // namespace nplc::verify
