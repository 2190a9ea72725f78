#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/story.h"
#include "findings.h"
#include "walk.h"

namespace nplc::verify {
namespace {

/// The relation of a scan of a group to the timer's zero, or to the counter's.
struct Use {
    ImageSet decided;            ///< images with which the zero decides the scan's effect
    ImageSet leads;              ///< those of them with which it decides the next step
    ImageSet acts;               ///< or else what is sent, or a preset; with the rest of them outputs alone
    std::uint8_t shows_on = 0;   ///< outputs that it decides alone: on at zero
    std::uint8_t shows_off = 0;  ///< off at zero
    bool sets = false;           ///< the timer or the counter
    bool leaves = false;         ///< the step, not only one of its copies
};

/// In more than step and outputs.
bool does_otherwise(const table::Outcome& a, const table::Outcome& b) {
    return a.timer != b.timer || a.counter != b.counter || a.counter_preset != b.counter_preset ||
           a.orders != b.orders;
}

std::vector<Use> uses_of(const Subject& subject, const Sensitivity& sensitivity, bool timer) {
    const Machine& machine = subject.explorer.machine();
    const auto origin = [&](std::uint8_t step) {
        return step <= sequencer::kLastStep ? subject.names.copy_of[step].value_or(step) : step;
    };
    std::vector<Use> uses;
    for (std::uint8_t step = 0; step <= sequencer::kLastStep; ++step) {
        for (unsigned zeros = 0; zeros < 4; ++zeros) {
            const bool timer_zero = (zeros & 1U) != 0;
            const bool counter_zero = (zeros & 2U) != 0;
            for (const Group& group : machine.groups(step, timer_zero, counter_zero)) {
                Use& use = uses.emplace_back();
                use.sets = timer ? group.outcome.timer != 0 : group.outcome.sets_counter();
                use.leaves = origin(group.outcome.next) != origin(step);
                if (timer ? timer_zero : counter_zero) {
                    use.decided = group.images & (timer ? sensitivity.to_timer(step, counter_zero)
                                                        : sensitivity.to_counter(step, timer_zero));
                    for (unsigned image = 0; image < 256 && use.decided.any(); ++image) {
                        if (!use.decided.test(image)) continue;
                        const Group& other =
                            machine.group_with(step, !timer && timer_zero, timer && counter_zero,
                                               static_cast<std::uint8_t>(image));
                        const table::Outcome& at_zero = group.outcome;
                        if (origin(at_zero.next) != origin(other.outcome.next)) {
                            use.leads.set(image);
                        } else if (does_otherwise(at_zero, other.outcome)) {
                            use.acts.set(image);
                        } else if (at_zero.outputs && other.outcome.outputs) {
                            const unsigned zero = *at_zero.outputs;
                            const unsigned running = *other.outcome.outputs;
                            use.shows_on = static_cast<std::uint8_t>(use.shows_on | (zero & ~running));
                            use.shows_off = static_cast<std::uint8_t>(use.shows_off | (~zero & running));
                        }
                    }
                }
            }
        }
    }
    return uses;
}

/// "OUT0 is on at once"
std::string shown_at_once(const Use& use, const Names& names) {
    std::vector<std::string> parts;
    const auto add = [&](std::uint8_t outputs, const char* level) {
        if (outputs == 0) return;
        parts.push_back(fmt::format("{} {} {}", outputs_text(outputs, names),
                                    std::popcount(outputs) > 1 ? "are" : "is", level));
    };
    add(use.shows_on, "on");
    add(use.shows_off, "off");
    return parts.empty() ? "its outputs are those at zero from the beginning"
                         : fmt::format("{} from the beginning", fmt::join(parts, ", "));
}

/// Not set: as at power-up, and after a scan in which its zero led to another step.
void begin_stale(const Explorer& explorer, const std::vector<Use>& uses, Walk& walk) {
    std::vector<bool> makes_stale;
    for (const Use& use : uses) makes_stale.push_back(use.leaves && !use.sets && use.decided.any());
    walk.begin_at_power_up(0);
    for (const Explorer::Edge& edge : explorer.edges()) {
        if (makes_stale[edge.group])
            walk.begin_with(edge, uses[edge.group].decided & explorer.images_of(edge), 0);
    }
}

/// A step that waits is told of before one that shows the zero.
enum Kind : std::uint8_t { kLeads, kActs, kShows, kKinds };

ImageSet images_of_kind(const Use& use, Kind kind) {
    return kind == kLeads  ? use.decided & use.leads
           : kind == kActs ? use.decided & use.acts
                           : use.decided & ~use.leads & ~use.acts;
}

Other other_stale(const Explorer& explorer, const std::shared_ptr<const std::vector<Use>>& uses,
                  std::uint8_t step, Kind kind) {
    return [=, &explorer](const OtherCourses& courses) {
        std::optional<Scans> course;
        Walk walk = courses.walk();
        begin_stale(explorer, *uses, walk);
        walk.all([&](const Walk::Scan& scan) {
            const Use& use = (*uses)[scan.edge.group];
            const ImageSet images = explorer.place(scan.edge.from).step == step
                                        ? images_of_kind(use, kind) & scan.images()
                                        : ImageSet{};
            if (images.any()) {
                course = scan.course(images);
                return scan.stop();
            }
            if (!use.sets) scan.go_on(0);
        });
        return course;
    };
}

/// V007: a zero that a step waits for, or shows, although it was never set or has already been used by
/// another step.
std::vector<Finding> find_stale(const Subject& subject, const Sensitivity& sensitivity, bool timer) {
    const Explorer& explorer = subject.explorer;
    const auto all_uses = std::make_shared<const std::vector<Use>>(uses_of(subject, sensitivity, timer));
    const std::vector<Use>& uses = *all_uses;
    Walk walk(explorer);
    begin_stale(explorer, uses, walk);
    std::array<std::array<std::optional<Finding>, 63>, kKinds> found;
    std::vector<std::uint8_t> steps;  // in the order of discovery
    const auto tell = [&](Kind kind, const Walk::Scan& scan, const ImageSet& images, const Use& use) {
        const std::uint8_t step = explorer.place(scan.edge.from).step;
        if (found[kind][step] || images.none()) return;
        if (std::find(steps.begin(), steps.end(), step) == steps.end()) steps.push_back(step);
        const char* what = timer ? "timer" : "counter";
        const std::string unset =
            fmt::format("the {} was not set since power-up or since it last led to another step", what);
        const std::string name = step_name(subject.names, step);
        const std::string zero = timer ? "TIMER.Q" : "COUNTER.Q";
        const std::string text =
            kind == kLeads
                ? fmt::format("step {} waits for {}, and {}: it goes on at once", name, zero, unset)
            : kind == kActs
                ? fmt::format("step {} does something with {}, and {}: it does so at once", name, zero, unset)
                : fmt::format("step {} shows {}, and {}: {}", name, zero, unset,
                              shown_at_once(use, subject.names));
        found[kind][step] = {"V007", step, text, scan.course(images),
                             other_stale(explorer, all_uses, step, kind)};
    };
    walk.all([&](const Walk::Scan& scan) {
        const Use& use = uses[scan.edge.group];
        if (!use.sets) scan.go_on(0);
        if (use.decided.none()) return;
        const ImageSet images = scan.images();
        for (const Kind kind : {kLeads, kActs, kShows})
            tell(kind, scan, images & images_of_kind(use, kind), use);
    });
    std::vector<Finding> findings;
    for (const std::uint8_t step : steps) {
        for (auto& of_kind : found) {
            if (!of_kind[step]) continue;
            findings.push_back(std::move(*of_kind[step]));
            break;
        }
    }
    return findings;
}

/// Steps that a timer at 0 leads to where a running one does not; kNoSwitch: the step stays active, with an
/// effect.
std::uint64_t led_to(const Machine& machine, const Sensitivity& sensitivity, std::uint8_t step) {
    std::uint64_t steps = 0;
    for (const bool counter_zero : {false, true}) {
        for (const Group& group : machine.groups(step, true, counter_zero)) {
            const std::uint8_t to = group.outcome.next == step ? sequencer::kNoSwitch : group.outcome.next;
            if ((group.images & sensitivity.to_timer(step, counter_zero)).any())
                steps |= std::uint64_t{1} << to;
        }
    }
    return steps;
}

/// V008: a timer that one step was to wait for and that another waits for while it still runs.
class OtherPurpose : public std::enable_shared_from_this<OtherPurpose> {
  public:
    OtherPurpose(const Subject& subject, const Sensitivity& sensitivity)
        : explorer_(subject.explorer), names_(subject.names) {
        for (std::uint8_t step = 0; step <= sequencer::kLastStep; ++step)
            leads_to_[step] = without_copies(led_to(explorer_.machine(), sensitivity, step));
    }

    std::vector<Finding> find() {
        for (const Group& group : explorer_.machine().all_groups())
            presets_.push_back(group.outcome.timer != 0);
        users_.resize(explorer_.size());
        Walk walk(explorer_);
        begin(walk);
        walk.all([&](const Walk::Scan& scan) {
            const std::uint8_t step = explorer_.place(scan.edge.from).step;
            const Walk::Memory user = user_in(scan);
            if (has_other_purpose(user, step) && !told_[step]) tell(scan, user, step);
            if (runs_on(scan) && is_new(scan.edge.to, user)) scan.go_on(user);
        });
        return std::move(findings_);
    }

  private:
    void begin(Walk& walk) const {
        for (const Explorer::Edge& edge : explorer_.edges()) {
            if (presets_[edge.group] && explorer_.place(edge.to).runs) walk.begin_with(edge, kUnused);
        }
    }

    std::optional<Scans> other(const OtherCourses& courses, Walk::Memory first, std::uint8_t step) const {
        std::optional<Scans> course;
        Walk walk = courses.walk();
        begin(walk);
        walk.all([&](const Walk::Scan& scan) {
            const Walk::Memory user = user_in(scan);
            if (user == first && explorer_.place(scan.edge.from).step == step) {
                course = scan.course(scan.images());
                return scan.stop();
            }
            if (runs_on(scan)) scan.go_on(user);
        });
        return course;
    }

    /// A copy of a step counts as that step.
    std::uint64_t without_copies(std::uint64_t steps) const {
        std::uint64_t result = 0;
        for (std::uint8_t step = 0; step <= sequencer::kLastStep; ++step) {
            if (((steps >> step) & 1U) != 0)
                result |= std::uint64_t{1} << names_.copy_of[step].value_or(step);
        }
        return result;
    }

    /// The first step that was to wait for the timer.
    Walk::Memory user_in(const Walk::Scan& scan) const {
        const std::uint8_t step = explorer_.place(scan.edge.from).step;
        return scan.memory == kUnused && leads_to_[step] != 0 ? static_cast<Walk::Memory>(kFirstUser + step)
                                                              : scan.memory;
    }
    bool has_other_purpose(Walk::Memory user, std::uint8_t step) const {
        return leads_to_[step] != 0 && leads_to_[user - kFirstUser] != leads_to_[step];
    }
    bool runs_on(const Walk::Scan& scan) const {
        return !presets_[scan.edge.group] && explorer_.place(scan.edge.to).runs;
    }

    void tell(const Walk::Scan& scan, Walk::Memory user, std::uint8_t step) {
        const auto first = static_cast<std::uint8_t>(user - kFirstUser);
        told_[step] = true;
        findings_.push_back(
            {"V008", step,
             fmt::format("the timer that step {} was to wait for still runs in step {}, which "
                         "goes elsewhere when it ends",
                         step_name(names_, first), step_name(names_, step)),
             scan.course(scan.images()),
             [keep = shared_from_this(), user, step](const OtherCourses& courses) {
                 return keep->other(courses, user, step);
             }});
    }

    /// At each node the first two users with different purposes are enough: for any step that follows, one of
    /// them had another purpose.
    bool is_new(Explorer::Node node, Walk::Memory user) {
        if (user == kUnused) return true;
        auto& [one, two] = users_[node];
        const auto purpose = [&](Walk::Memory of) { return leads_to_[of - kFirstUser]; };
        if (one == kUnused) {
            one = user;
            return true;
        }
        if (two != kUnused || purpose(one) == purpose(user)) return false;
        two = user;
        return true;
    }

    static constexpr Walk::Memory kUnused = 0;
    static constexpr Walk::Memory kFirstUser = 1;

    const Explorer& explorer_;
    const Names& names_;
    std::array<std::uint64_t, 63> leads_to_{};
    std::vector<bool> presets_;                       ///< by group
    std::vector<std::array<Walk::Memory, 2>> users_;  ///< by node
    std::array<bool, 63> told_{};
    std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> check_zeros(const Subject& subject) {
    const Sensitivity sensitivity(subject.explorer.machine());
    std::vector<Finding> findings = find_stale(subject, sensitivity, true);
    for (const Finding& finding : find_stale(subject, sensitivity, false)) findings.push_back(finding);
    for (const Finding& finding : std::make_shared<OtherPurpose>(subject, sensitivity)->find())
        findings.push_back(finding);
    return findings;
}

}  // namespace nplc::verify
