#include "decider.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "monitor.h"
#include "surely.h"

namespace nplc::verify {
namespace {

constexpr std::size_t kMostTimedStates = 400'000;

constexpr const char* kNoTimes =
    "there is a course that breaks it but for the times that an input stays as it is; neither these times "
    "nor "
    "another course were found (--assume any leaves such times out)";

constexpr const char* kNotSurely =
    "a course leads there from each state if timer and inputs are left free; whether one does with their "
    "times "
    "was not found (--assume any leaves such times out)";

}  // namespace

std::string out_of_bounds(const Explorer& explorer) {
    return fmt::format("{} states were explored, and there are more", explorer.size());
}

Decider::Decider(const sequencer::Table& table, const Machine& machine, const Options& options,
                 std::vector<Target> targets)
    : table_(table), machine_(machine), options_(options), targets_(std::move(targets)) {
    if (options.assume == Assume::driver) stable_ms_.fill(options.debounce_ms);
    for (const Assumption& assumption : options.assumptions)
        stable_ms_[assumption.input] = std::max(stable_ms_[assumption.input], assumption.stable_ms);
    coarse_ = std::make_unique<Explorer>(
        machine, Precision{.knows_lost_link = true, .keeps_edges = true, .most_states = options.most_states});
    coarse_->explore(targets_);
}

std::optional<Course> Decider::realized(const std::vector<CourseScan>& scans,
                                        const std::optional<Overdue>& overdue) const {
    return realize({.table = table_, .assume = options_.assume, .stable_ms = stable_ms_}, scans, overdue);
}

const Explorer& Decider::fine() {
    if (!fine_) {
        fine_ = std::make_unique<Explorer>(
            machine_, Precision{.times_timer = true, .keeps_edges = true, .most_states = kMostTimedStates});
        fine_->explore(targets_);
    }
    return *fine_;
}

Decider::Finding Decider::scan_of_target(std::size_t target) {
    if (!coarse_->hit(target)) {
        if (coarse_->complete()) return {Answer::cannot_be, {}, {}};
        return {Answer::unknown, {}, out_of_bounds(*coarse_)};
    }
    if (auto course = realized(coarse_->course_to(target))) return {Answer::can_be, std::move(course), {}};
    const Explorer& exact = fine();
    if (!exact.hit(target)) {
        if (exact.complete()) return {Answer::cannot_be, {}, {}};
        return {Answer::unknown, {}, out_of_bounds(exact)};
    }
    if (auto course = realized(exact.course_to(target))) return {Answer::can_be, std::move(course), {}};
    return {Answer::unknown, {}, kNoTimes};
}

Decider::Finding Decider::missed_deadline(const Property& property) const {
    std::string why;
    for (const bool times_timer : {false, true}) {
        Explorer explorer(
            machine_,
            Precision{.times_timer = times_timer, .deadline = &property, .most_states = kMostTimedStates});
        explorer.explore({});
        if (!explorer.missed_deadline()) {
            if (explorer.complete()) return {Answer::cannot_be, {}, {}};
            why = out_of_bounds(explorer);
            continue;
        }
        const std::vector<CourseScan> scans = explorer.course_to_missed_deadline();
        const std::size_t to = explorer.missed_at_end() ? scans.size() - 1 : scans.size();
        const std::uint32_t more_than = property.within_ms - (property.form == Form::never_while ? 1 : 0);
        Overdue overdue{.from = scans.size() - 1, .to = to, .more_than_ms = more_than};
        while (scans[overdue.from].place.pending) --overdue.from;
        if (auto course = realized(scans, overdue)) return {Answer::can_be, std::move(course), {}};
        why = kNoTimes;
    }
    return {Answer::unknown, {}, why};
}

Decider::Finding Decider::remembered(const Property& property) {
    if (!coarse_->has_all_edges()) return {Answer::unknown, {}, out_of_bounds(*coarse_)};
    const auto scans = breaking_course(*coarse_, property);
    if (!scans) return {Answer::cannot_be, {}, {}};
    if (auto course = realized(*scans)) return {Answer::can_be, std::move(course), {}};
    const Explorer& exact = fine();
    if (!exact.has_all_edges()) return {Answer::unknown, {}, out_of_bounds(exact)};
    const auto timed = breaking_course(exact, property);
    if (!timed) return {Answer::cannot_be, {}, {}};
    if (auto course = realized(*timed)) return {Answer::can_be, std::move(course), {}};
    return {Answer::unknown, {}, kNoTimes};
}

const std::vector<bool>& Decider::ways_to(const Target& target) {
    if (back_.empty()) {
        first_back_.assign(coarse_->size() + 1, 0);
        for (const auto& edge : coarse_->edges()) ++first_back_[edge.to + 1];
        for (std::size_t i = 1; i < first_back_.size(); ++i) first_back_[i] += first_back_[i - 1];
        back_.resize(coarse_->edges().size());
        std::vector<std::uint32_t> next(first_back_.begin(), first_back_.end());
        for (const auto& edge : coarse_->edges()) back_[next[edge.to]++] = edge.from;
    }
    good_.assign(coarse_->size(), false);
    std::vector<Explorer::Node> open;
    for (Explorer::Node node = 0; node < coarse_->size(); ++node) {
        if (!coarse_->can_hit_from(node, target)) continue;
        good_[node] = true;
        open.push_back(node);
    }
    while (!open.empty()) {
        const Explorer::Node node = open.back();
        open.pop_back();
        for (std::uint32_t i = first_back_[node]; i < first_back_[node + 1]; ++i) {
            if (good_[back_[i]]) continue;
            good_[back_[i]] = true;
            open.push_back(back_[i]);
        }
    }
    return good_;
}

bool Decider::assumes_stable_inputs() const {
    return std::any_of(options_.assumptions.begin(), options_.assumptions.end(),
                       [](const Assumption& assumption) { return assumption.stable_ms != 0; });
}

Decider::Finding Decider::stuck_outside(std::size_t index) {
    const Target& target = targets_[index];
    const std::vector<bool>& good = ways_to(target);
    if (!coarse_->has_all_edges()) return {Answer::unknown, {}, out_of_bounds(*coarse_)};
    const Explorer::Stuck stuck = coarse_->first_stuck(target, good);
    if (stuck.node == Explorer::kNone) {
        const bool is_exact = options_.assume == Assume::any && !assumes_stable_inputs();
        if (is_exact) return {Answer::cannot_be, {}, {}};
        if (!assumes_stable_inputs() && surely_possible(*coarse_, target)) return {Answer::cannot_be, {}, {}};
        return {Answer::unknown, {}, kNotSurely};
    }
    if (auto course = realized(coarse_->course_to(stuck))) return {Answer::can_be, std::move(course), {}};
    return {Answer::unknown, {}, kNoTimes};
}

}  // namespace nplc::verify
