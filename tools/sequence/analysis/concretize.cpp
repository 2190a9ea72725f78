#include "concretize.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <set>

#include "preset_values.h"
#include "sequencer/engine.h"

namespace nplc::verify {
namespace {

using Images = std::vector<std::uint8_t>;

/// The cost of a changed input between two scans.
class ChangeCosts {
  public:
    explicit ChangeCosts(std::size_t scans) : more_(scans + 1) {}

    void raise(std::size_t scan, unsigned input) { more_[scan][input] += 4 * kChange; }
    std::uint32_t of_bit(std::size_t scan, unsigned bit) const { return kChange + more_[scan][bit]; }
    std::uint32_t of(std::size_t scan, unsigned bits) const {
        std::uint32_t cost = 0;
        for (; bits != 0; bits &= bits - 1)
            cost += of_bit(scan, static_cast<unsigned>(std::countr_zero(bits)));
        return cost;
    }

  private:
    static constexpr std::uint32_t kChange = 4;
    std::vector<std::array<std::uint32_t, 8>> more_;  ///< by scan and bit
};

constexpr std::uint32_t kNever = 1'000'000'000;
using Costs = std::array<std::uint32_t, 256>;

/// The least cost of a course up to a scan with each image.
std::vector<Costs> costs_of(std::span<const CourseScan> scans, const ChangeCosts& changes) {
    std::vector<Costs> costs(scans.size());
    Costs reach{};
    for (unsigned image = 0; image < 256; ++image)
        reach[image] =
            static_cast<std::uint32_t>(std::popcount(image));  // the first one is free, off is calmer
    for (std::size_t k = 0; k < scans.size(); ++k) {
        for (unsigned image = 0; image < 256; ++image) {
            const bool possible = scans[k].images[image] && reach[image] < kNever;
            costs[k][image] = possible ? reach[image] + ((image & sequencer::kError) != 0 ? 1U : 0U) : kNever;
        }
        reach = costs[k];
        for (unsigned bit = 0; bit < 8; ++bit) {
            Costs next = reach;
            for (unsigned image = 0; image < 256; ++image)
                next[image] = std::min(reach[image], reach[image ^ (1U << bit)] + changes.of_bit(k + 1, bit));
            reach = next;
        }
    }
    return costs;
}

/// The possible images with the least cost of changes. ERROR has a small cost, so that it appears only where
/// it is needed.
Images calm_images(std::span<const CourseScan> scans, const ChangeCosts& changes) {
    const std::vector<Costs> costs = costs_of(scans, changes);
    Images images(scans.size());
    for (std::size_t k = scans.size(); k-- > 0;) {
        std::uint32_t best = std::numeric_limits<std::uint32_t>::max();
        for (unsigned image = 0; image < 256; ++image) {
            if (costs[k][image] >= kNever) continue;
            const std::uint32_t change =
                k + 1 < scans.size() ? changes.of(k + 1, image ^ unsigned{images[k + 1]}) : 0;
            if (costs[k][image] + change < best) {
                best = costs[k][image] + change;
                images[k] = static_cast<std::uint8_t>(image);
            }
        }
    }
    return images;
}

/// The reason for a bound on a time, and the scans it refers to.
struct Cause {
    enum class Kind : std::uint8_t { delay, timer_runs, timer_ends, move, change, keeps, overdue };
    Kind kind = Cause::Kind::delay;
    std::size_t first = 0;
    std::size_t last = 0;
    unsigned input = 0;
};

/// Solves `later - sooner >= least` for the earliest times.
class Times {
  public:
    struct Bound {
        std::size_t sooner;
        std::size_t later;
        std::int64_t least;
        Cause cause;
    };

    explicit Times(std::size_t count) : at_(count) {}

    std::size_t add() {
        at_.push_back(0);
        return at_.size() - 1;
    }
    void at_least(std::size_t sooner, std::size_t later, std::int64_t least, const Cause& cause) {
        bounds_.push_back({sooner, later, least, cause});
    }
    void at_most(std::size_t sooner, std::size_t later, std::int64_t most, const Cause& cause) {
        bounds_.push_back({later, sooner, -most, cause});
    }

    bool solve() {
        raised_by_.assign(at_.size(), bounds_.size());
        for (std::size_t round = 0; round <= at_.size(); ++round) {
            bool changed = false;
            for (std::size_t i = 0; i < bounds_.size(); ++i) {
                const Bound& b = bounds_[i];
                if (at_[b.later] - at_[b.sooner] >= b.least) continue;
                at_[b.later] = at_[b.sooner] + b.least;
                raised_by_[b.later] = i;
                last_raised_ = b.later;
                changed = true;
            }
            if (!changed) return true;
        }
        return false;
    }
    std::int64_t operator[](std::size_t i) const { return at_[i]; }

    /// Cyclic bounds that need more time than there is; only after solving has failed.
    std::vector<Bound> round() const {
        std::size_t at = last_raised_;
        for (std::size_t i = 0; i < at_.size(); ++i) at = bounds_[raised_by_[at]].sooner;
        std::vector<Bound> bounds;
        const std::size_t begin = at;
        do {
            bounds.push_back(bounds_[raised_by_[at]]);
            at = bounds.back().sooner;
        } while (at != begin);
        return bounds;
    }

  private:
    std::vector<std::int64_t> at_;
    std::vector<Bound> bounds_;
    std::vector<std::size_t> raised_by_;  ///< by time, the bound that raised it last
    std::size_t last_raised_ = 0;
};

/// Time k is that of scan k; the last one that of the scan that would follow.
void bound_delays(Times& times, std::span<const CourseScan> scans) {
    for (std::size_t k = 0; k < scans.size(); ++k) {
        const Cause cause{.first = k, .last = k};
        times.at_least(k, k + 1, scans[k].delay.least, cause);
        if (scans[k].delay.most < kEndless) times.at_most(k, k + 1, scans[k].delay.most, cause);
    }
}

/// Repeated scans also read the end of the timer: they are `most_idle` apart.
void bound_timer(Times& times, std::span<const CourseScan> scans, bool paced,
                 std::span<const ChosenPreset> presets) {
    std::size_t preset_at = 0;
    std::int64_t preset = 0;
    for (std::size_t k = 0; k < scans.size(); ++k) {
        if (preset != 0) {
            if (scans[k].place.runs) {
                times.at_most(preset_at, k, preset - 1, {Cause::Kind::timer_runs, preset_at, k - 1});
            } else {
                times.at_least(preset_at, k, preset, {Cause::Kind::timer_ends, preset_at, k - 1});
                preset = 0;
            }
        }
        const bool runs_on = preset != 0 && scans[k].place.runs;
        if (paced && runs_on && scans[k].idle)
            times.at_most(preset_at, k + 1, preset - 1 + Machine::kMostIdle,
                          {Cause::Kind::timer_runs, preset_at, k});
        if (scans[k].group->outcome.timer == 0) continue;
        preset = chosen_value(presets, scans[k].group->outcome.timer);
        preset_at = k;
    }
}

/// A scan that reads a move to a position as neither ended nor disturbed is within the duration of the move,
/// and so are its repetitions.
void bound_moves(Times& times, std::span<const CourseScan> scans, std::uint32_t move_ms, bool paced) {
    std::size_t ordered = 0;
    for (std::size_t k = 0; k < scans.size(); ++k) {
        const Group& group = *scans[k].group;
        if (is_timed(scans[k].place.motion) && !group.in_pos && !group.disturbs) {
            const Cause cause{Cause::Kind::move, ordered, k};
            times.at_most(ordered, k, move_ms, cause);
            if (paced && scans[k].idle) times.at_most(ordered, k + 1, move_ms + Machine::kMostIdle, cause);
        }
        if (begins_move(group.outcome.orders)) ordered = k;
    }
}

/// An input that a scan reads as changed has changed after the scan before and its repetitions, and not
/// before it was steady.
void bound_inputs(Times& times, std::span<const CourseScan> scans, const Images& images, bool paced,
                  const std::array<std::uint32_t, 6>& stable_ms) {
    for (unsigned input = 0; input < stable_ms.size(); ++input) {
        const unsigned bit = 1U << input;
        if (stable_ms[input] == 0) continue;
        std::optional<std::size_t> before;
        std::size_t changed_in = 0;
        for (std::size_t k = 1; k < images.size(); ++k) {
            if (((images[k] ^ images[k - 1]) & bit) == 0) continue;
            const std::size_t change = times.add();
            const Cause cause{Cause::Kind::change, k - 1, k, input};
            times.at_least(k - 1, change, -std::int64_t{scans[k - 1].group->delay.end}, cause);
            times.at_least(change, k, 0, cause);
            if (paced && scans[k - 1].idle)
                times.at_least(k, change, -std::int64_t{Machine::kMostIdle}, cause);
            if (before)
                times.at_least(*before, change, stable_ms[input], {Cause::Kind::keeps, changed_in, k, input});
            before = change;
            changed_in = k;
        }
    }
}

std::string words_of(const Times::Bound& bound, std::span<const CourseScan> scans) {
    const auto scan = [&](std::size_t k) { return fmt::format("scan {}", k + 1); };
    const std::int64_t ms = std::abs(bound.least);
    switch (bound.cause.kind) {
        case Cause::Kind::timer_ends:
            return fmt::format("the timer of {} ms, preset in {}, has ended in {}", ms,
                               scan(bound.cause.first), scan(bound.cause.last + 1));
        case Cause::Kind::timer_runs:
            return fmt::format("the timer preset in {} still runs in {}", scan(bound.cause.first),
                               scan(bound.cause.last + 1));
        case Cause::Kind::move:
            return fmt::format("the move ordered in {} has not ended in {}, at most {} ms later",
                               scan(bound.cause.first), scan(bound.cause.last), ms);
        case Cause::Kind::keeps:
            return fmt::format("IN{} keeps its level for {} ms, and is another in {} and in {}",
                               bound.cause.input, ms, scan(bound.cause.first), scan(bound.cause.last));
        case Cause::Kind::overdue:
            return fmt::format("{} ms pass from {} on", ms, scan(bound.cause.first));
        case Cause::Kind::delay:
            if (bound.least == 0 ||
                scans[bound.cause.first].delay.least == scans[bound.cause.first].delay.most)
                return "";
            return fmt::format("{} {} ms pass after {}", bound.sooner < bound.later ? "at least" : "at most",
                               ms, scan(bound.cause.first));
        case Cause::Kind::change:
            return "";
    }
    return "";
}

/// For unsolvable times: the scans that conflict. Equal delays are listed once.
Conflict conflict_of(const std::vector<Times::Bound>& round, std::span<const CourseScan> scans) {
    Conflict conflict{.first = scans.size() - 1, .last = 0, .words = {}};
    std::set<std::string> told;
    std::int64_t most = 0;
    for (const Times::Bound& bound : round) {
        conflict.first = std::min(conflict.first, bound.cause.first);
        conflict.last = std::max(conflict.last, std::min(bound.cause.last, scans.size() - 1));
        conflict.exact = conflict.exact || bound.cause.kind == Cause::Kind::keeps ||
                         bound.cause.kind == Cause::Kind::change;
        conflict.overdue = conflict.overdue || bound.cause.kind == Cause::Kind::overdue;
        if (bound.cause.kind == Cause::Kind::delay) {
            if (bound.sooner > bound.later) most -= bound.least;
            continue;
        }
        const std::string words = words_of(bound, scans);
        if (words.empty() || !told.insert(words).second) continue;
        conflict.words += (conflict.words.empty() ? "" : ", ") + words;
    }
    if (most != 0)
        conflict.words += fmt::format("{}no more than {} ms can pass between these scans",
                                      conflict.words.empty() ? "" : "; but ", most);
    return conflict;
}

/// Repeats idle scans where time passes, so that no two are further apart than the gateway's.
Course lay_out(std::span<const CourseScan> scans, const Images& images, const Times& times, bool paced,
               const std::optional<Overdue>& overdue) {
    Course course;
    for (std::size_t k = 0; k < scans.size(); ++k) {
        PlayedScan scan;
        scan.image = images[k];
        scan.begins = overdue && overdue->from == k;
        std::int64_t rest = times[k + 1] - times[k];
        while (paced && scans[k].idle && rest > Machine::kMostIdle) {
            scan.dt_ms = rest % Machine::kMostIdle != 0 ? 1 : Machine::kMostIdle;
            course.push_back(scan);
            scan.repeats = true;
            scan.begins = false;
            rest -= scan.dt_ms;
        }
        scan.dt_ms = static_cast<std::uint32_t>(rest);
        course.push_back(scan);
    }
    return course;
}

/// Executes the course on the engine itself; false if the result differs from the explorer's.
bool play(const sequencer::Table& table, std::span<const CourseScan> scans, Course& course) {
    sequencer::Engine engine(table);
    std::size_t k = 0;
    for (std::size_t i = 0; i < course.size(); ++i) {
        PlayedScan& scan = course[i];
        scan.step = engine.state().step;
        engine.scan(scan.image, [&](const sequencer::MotorOrder& order) { scan.orders.push_back(order); });
        scan.after = engine.state();
        const CourseScan& thought = scans[k];
        const View& view = thought.view;
        const bool as_thought = scan.step == thought.place.step && scan.after.step == view.step &&
                                scan.after.outputs == view.outputs &&
                                (scan.after.timer == 0) == view.timer_zero &&
                                (scan.after.counter == 0) == view.counter_zero;
        if (!as_thought) return false;
        engine.elapse(scan.dt_ms);
        if (i + 1 < course.size() && !course[i + 1].repeats) ++k;
    }
    return k + 1 == scans.size();
}

}  // namespace

Attempt concretize(const Realization& how, std::span<const CourseScan> scans,
                   const std::optional<Overdue>& overdue) {
    if (scans.empty()) return {.course = Course{}, .conflict = {}};
    constexpr int kMostImages = 8;
    const bool driver = how.assume == Assume::driver;
    ChangeCosts changes(scans.size());
    Images images;
    Conflict conflict;
    for (int choice = 0; choice < kMostImages; ++choice) {
        Images others = calm_images(scans, changes);
        if (others == images) break;
        images = std::move(others);
        Times times(scans.size() + 1);
        bound_delays(times, scans);
        bound_timer(times, scans, driver, how.presets);
        if (how.move_ms != 0) bound_moves(times, scans, how.move_ms, driver);
        bound_inputs(times, scans, images, driver, how.stable_ms);
        if (overdue)
            times.at_least(overdue->from, overdue->to, std::int64_t{overdue->more_than_ms} + 1,
                           {Cause::Kind::overdue, overdue->from, scans.size() - 1});
        if (times.solve()) {
            Course course = lay_out(scans, images, times, driver, overdue);
            if (play(how.table, scans, course)) return {.course = std::move(course), .conflict = {}};
            return {.course = {},
                    .conflict = {
                        .last = scans.size() - 1, .exact = true, .words = "the engine takes another course"}};
        }
        const std::vector<Times::Bound> round = times.round();
        conflict = conflict_of(round, scans);
        if (!conflict.exact) break;
        for (const Times::Bound& bound : round) {
            if (bound.cause.kind == Cause::Kind::change) changes.raise(bound.cause.last, bound.cause.input);
        }
    }
    return {.course = {}, .conflict = std::move(conflict)};
}

}  // namespace nplc::verify
