#include "decider.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "error_ways.h"
#include "guaranteed_reachability.h"
#include "monitor.h"
#include "preset_values.h"

namespace nplc::verify {
namespace {

constexpr std::size_t kMostTimedStates = 400'000;

/// Courses were found, but no times fit any of them.
constexpr const char* kNoTimes =
    "there is a course that breaks it but for times, and neither these times nor another course were found "
    "(--assume any leaves such times out)";

constexpr const char* kNotSurely =
    "a course leads there from each state if timer and inputs are left free; whether one exists with their "
    "times "
    "was not found";
constexpr const char* kLeavesTimesOut = " (--assume any leaves such times out)";

}  // namespace

std::string out_of_bounds(const Explorer& explorer) {
    return fmt::format(
        "{} states were explored, and there are more{}; what leaves fewer may decide it: a count or a RANGE "
        "of "
        "counts that ends sooner (each count is a state of its own), ASSUME "
        "NEVER ERROR, ASSUME NEVER of inputs that cannot be together, a shorter time, or --assume "
        "any, which has no times",
        explorer.size(), explorer.complete() ? " scans between them than are kept" : "");
}

Decider::Decider(const sequencer::Table& table, const Machine& machine, const Options& options,
                 std::vector<Target> targets)
    : table_(table), machine_(machine), options_(options), targets_(std::move(targets)) {
    if (options.assume == Assume::driver) stable_ms_.fill(options.debounce_ms);
    for (const Assumption& assumption : options.assumptions)
        stable_ms_[assumption.input] = std::max(stable_ms_[assumption.input], assumption.stable_ms);
    // guaranteed_reachability.h counts on 3 ms of debounce, or on the driver's debounce time.
    const std::uint32_t each_ms = options.assume == Assume::driver ? options.debounce_ms : 3;
    for (std::size_t input = 0; input < stable_ms_.size(); ++input)
        held_ |= static_cast<std::uint8_t>(stable_ms_[input] > each_ms ? 1U << input : 0U);
    coarse_ = std::make_unique<Explorer>(
        machine, Precision{.knows_lost_link = true, .keeps_edges = true, .most_states = options.most_states});
    coarse_->explore(targets_);
}

Decider::Attempted Decider::attempted(const Way& way) const {
    Attempted result;
    bool is_first = true;
    for (std::vector<ChosenPreset>& presets : choices_for(machine_, way.scans)) {
        const std::vector<std::uint8_t> bytes = bytes_with(table_, presets);
        const sequencer::Table::LoadResult with_values = sequencer::Table::load(bytes);
        Attempt attempt = concretize({.table = with_values.table,
                                      .assume = options_.assume,
                                      .stable_ms = stable_ms_,
                                      .move_ms = machine_.move_ms(),
                                      .presets = presets},
                                     way.scans, way.overdue);
        if (attempt.course) {
            result.played = Played{.course = std::move(*attempt.course), .presets = std::move(presets)};
            return result;
        }
        if (is_first) {
            result.conflict = std::move(attempt.conflict);
        } else {
            result.conflict.join(attempt.conflict);
        }
        is_first = false;
    }
    if (is_first) {
        result.conflict = {
            .last = way.scans.size() - 1, .exact = true, .words = "a range has two different counts"};
    }
    return result;
}

Decider::Finding Decider::tried(Excluded& excluded, const Ask& ask) const {
    constexpr std::uint64_t kImagesWork = 128;  // work per scan to choose its image
    Finding finding;
    int tries = 0;
    while (tries == 0 || (tries < kMostTries && !excluded.is_worn_out())) {
        const std::optional<Way> way = ask(excluded);
        if (!way) break;
        ++tries;
        Attempted attempt = attempted(*way);
        excluded.count_work(kImagesWork * way->scans.size());
        if (attempt.played) return {.answer = Answer::can_be, .played = std::move(attempt.played)};
        finding.conflict = attempt.conflict.words;
        excluded.add(way->scans, attempt.conflict);
    }
    finding.why = fmt::format(
        "{} course{} {} tried, and the times of none can be (--explain-undecided says why; --assume any "
        "leaves such times out)",
        tries, tries == 1 ? "" : "s", tries == 1 ? "was" : "were");
    return finding;
}

Decider::Finding Decider::or_tried(Finding open, const Explorer& explorer, const Ask& ask) const {
    if (open.answer != Answer::unknown || !explorer.has_all_edges()) return open;
    Excluded excluded(explorer);
    Finding finding = tried(excluded, ask);
    if (finding.answer == Answer::unknown && open.why != kNoTimes) return open;
    return finding;
}

bool Decider::is_reached_with_all(std::size_t target) const {
    return !has_ranges() || (coarse_->has_all_edges() && surely_reached(*coarse_, targets_[target], held_));
}

std::optional<Played> Decider::course_to_only_by_error(std::size_t target) const {
    constexpr int kMostCourses = 20;
    if (!coarse_->has_all_edges()) return std::nullopt;
    const ErrorWays ways(*coarse_, targets_[target]);
    if (!ways.course_to_only_by_error()) return std::nullopt;
    Excluded excluded(*coarse_);
    Finding finding =
        tried(excluded, [&, left = kMostCourses](Excluded& known) mutable -> std::optional<Way> {
            if (left-- == 0) return std::nullopt;
            auto scans = ways.course_to_only_by_error(&known);
            if (!scans) return std::nullopt;
            return Way{.scans = std::move(*scans)};
        });
    return std::move(finding.played);
}

bool Decider::is_reached_only_by_error(std::size_t target) const {
    return coarse_->has_all_edges() &&
           ErrorWays(*coarse_, targets_[target]).lead_from_power_up_only_by_error();
}

const Explorer& Decider::fine() {
    if (!fine_) {
        fine_ = std::make_unique<Explorer>(
            machine_, Precision{.times_timer = true, .keeps_edges = true, .most_states = kMostTimedStates});
        fine_->explore({});
    }
    return *fine_;
}

const Explorer& Decider::punctual() {
    if (!punctual_) {
        punctual_ = std::make_unique<Explorer>(machine_, Precision{.knows_lost_link = true,
                                                                   .keeps_edges = true,
                                                                   .waits_for_line = false,
                                                                   .most_states = options_.most_states});
        punctual_->explore({});
    }
    return *punctual_;
}

Decider::Finding Decider::scan_of_target(std::size_t target) {
    return or_tried(explored_scan(target), *coarse_,
                    [&](Excluded& excluded) { return way_to_target(*coarse_, targets_[target], excluded); });
}

Decider::Finding Decider::explored_scan(std::size_t target) {
    if (!coarse_->hit(target)) {
        if (coarse_->complete()) return {.answer = Answer::cannot_be};
        return {.why = out_of_bounds(*coarse_)};
    }
    if (auto played = realized(coarse_->course_to(target)))
        return {.answer = Answer::can_be, .played = std::move(played)};
    if (!coarse_->has_all_edges()) return {.why = out_of_bounds(*coarse_)};
    const std::vector<std::uint32_t> distances = distances_to(*coarse_, targets_[target]);
    Explorer exact(machine_, Precision{.times_timer = true,
                                       .most_states = kMostTimedStates,
                                       .guide = coarse_.get(),
                                       .distances = &distances});
    exact.explore({targets_[target]});
    if (!exact.hit(0)) {
        if (exact.complete()) return {.answer = Answer::cannot_be};
        return {.why = out_of_bounds(exact)};
    }
    if (auto played = realized(exact.course_to(0)))
        return {.answer = Answer::can_be, .played = std::move(played)};
    return {.why = kNoTimes};
}

Decider::Finding Decider::missed_deadline(const Property& property) {
    Finding open = explored_deadline(property);
    if (open.answer != Answer::unknown) return open;
    const Explorer& ways = punctual();
    Finding finding;
    for (const bool cuts : {false, true}) {
        finding = or_tried(open, ways,
                           [&](Excluded& excluded) { return late_way(ways, property, cuts, excluded); });
        if (finding.answer != Answer::unknown) break;
    }
    return finding;
}

Decider::Finding Decider::explored_deadline(const Property& property) const {
    Finding finding;
    for (const bool times_timer : {false, true}) {
        Precision precision{
            .times_timer = times_timer, .deadline = &property, .most_states = kMostTimedStates};
        finding = explored_deadline(property, precision);
        if (finding.answer != Answer::unknown) return finding;
        precision.waits_for_line = false;
        const Finding without = explored_deadline(property, precision);
        if (without.answer == Answer::can_be) return without;
    }
    return finding;
}

Decider::Finding Decider::explored_deadline(const Property& property, const Precision& precision) const {
    Explorer explorer(machine_, precision);
    explorer.explore({});
    if (!explorer.missed_deadline()) {
        if (explorer.complete()) return {.answer = Answer::cannot_be};
        return {.why = out_of_bounds(explorer)};
    }
    const std::vector<CourseScan> scans = explorer.course_to_missed_deadline();
    const std::size_t to = explorer.missed_at_end() ? scans.size() - 1 : scans.size();
    const std::uint32_t more_than = property.within_ms - (property.form == Form::never_while ? 1 : 0);
    Overdue overdue{.from = scans.size() - 1, .to = to, .more_than_ms = more_than};
    while (scans[overdue.from].place.pending) --overdue.from;
    if (auto played = realized(scans, overdue))
        return {.answer = Answer::can_be, .played = std::move(played)};
    return {.why = kNoTimes};
}

Decider::Finding Decider::remembered(const Property& property) {
    return or_tried(explored_memory(property), *coarse_, [&](Excluded& excluded) -> std::optional<Way> {
        auto scans = breaking_course(*coarse_, property, &excluded);
        if (!scans) return std::nullopt;
        return Way{.scans = std::move(*scans)};
    });
}

Decider::Finding Decider::explored_memory(const Property& property) {
    if (!coarse_->has_all_edges()) return {.why = out_of_bounds(*coarse_)};
    const auto scans = breaking_course(*coarse_, property);
    if (!scans) return {.answer = Answer::cannot_be};
    if (auto played = realized(*scans)) return {.answer = Answer::can_be, .played = std::move(played)};
    const Explorer& exact = fine();
    if (!exact.has_all_edges()) return {.why = out_of_bounds(exact)};
    const auto timed = breaking_course(exact, property);
    if (!timed) return {.answer = Answer::cannot_be};
    if (auto played = realized(*timed)) return {.answer = Answer::can_be, .played = std::move(played)};
    return {.why = kNoTimes};
}

bool Decider::assumes_stable_inputs() const {
    return std::any_of(options_.assumptions.begin(), options_.assumptions.end(),
                       [](const Assumption& assumption) { return assumption.stable_ms != 0; });
}

std::string Decider::why_not_surely(const Target& target, const ScanKeys* only) const {
    std::string why = kNotSurely;
    if (held_ != 0 && surely_possible(*coarse_, target, 0, only)) {
        std::string assumptions;
        for (const Assumption& assumption : options_.assumptions) {
            if (assumption.stable_ms == 0 || ((held_ >> assumption.input) & 1U) == 0) continue;
            assumptions += (assumptions.empty() ? "" : " and ") + assumption.text;
        }
        return fmt::format("{}; without {} it is proved", why, assumptions);
    }
    if (options_.assume == Assume::driver) why += kLeavesTimesOut;
    return why;
}

Decider::Finding Decider::stuck_outside(std::size_t index) {
    Stuck stuck;
    Finding open = explored_stuck(targets_[index], stuck);
    if (stuck.node == Explorer::kNone) return open;
    return or_tried(std::move(open), *coarse_,
                    [&](Excluded& excluded) { return way_to_stuck(*coarse_, stuck, excluded); });
}

/// `stuck`: one of the coarse exploration, or null.
Decider::Finding Decider::explored_stuck(const Target& target, Stuck& stuck) {
    if (!coarse_->has_all_edges()) return {.why = out_of_bounds(*coarse_)};
    const std::vector<std::uint32_t> distances = distances_to(*coarse_, target);
    stuck = first_stuck(*coarse_, target, distances);
    if (stuck.node == Explorer::kNone) {
        const bool is_exact = options_.assume == Assume::any && !assumes_stable_inputs() &&
                              machine_.move_ms() == 0 && !has_ranges();
        if (is_exact) return {.answer = Answer::cannot_be};
        if (surely_possible(*coarse_, target, held_)) return {.answer = Answer::cannot_be};
        return {.why = why_not_surely(target)};
    }
    if (auto played = realized(course_to(*coarse_, stuck)))
        return {.answer = Answer::can_be, .played = std::move(played)};
    const Explorer& exact = fine();  // without the scans that no times permit
    if (!exact.has_all_edges()) return {.why = out_of_bounds(exact)};
    const ScanKeys scans = scans_of(exact);
    stuck = first_stuck(*coarse_, target, distances, &scans);
    if (stuck.node == Explorer::kNone) {
        if (surely_possible(*coarse_, target, held_, &scans)) return {.answer = Answer::cannot_be};
        return {.why = why_not_surely(target, &scans)};
    }
    const Stuck there = same_scan(exact, coarse_->place(stuck.node), stuck);
    if (auto played = realized(course_to(exact, there)))
        return {.answer = Answer::can_be, .played = std::move(played)};
    return {.why = kNoTimes};
}

}  // namespace nplc::verify
