#include "realize.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "preset_values.h"
#include "sequencer/engine.h"

namespace nplc::verify {
namespace {

using Images = std::vector<std::uint8_t>;

/// Of all images that a course can have, those with the fewest changes; ERROR costs a little, so that none is
/// there without need.
Images calm_images(std::span<const CourseScan> scans) {
    constexpr std::uint32_t kChange = 4;
    constexpr std::uint32_t kNever = 1'000'000'000;
    using Costs = std::array<std::uint32_t, 256>;
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
        for (unsigned bit = 1; bit < 256; bit <<= 1U) {
            Costs next = reach;
            for (unsigned image = 0; image < 256; ++image)
                next[image] = std::min(reach[image], reach[image ^ bit] + kChange);
            reach = next;
        }
    }
    Images images(scans.size());
    for (std::size_t k = scans.size(); k-- > 0;) {
        std::uint32_t best = std::numeric_limits<std::uint32_t>::max();
        for (unsigned image = 0; image < 256; ++image) {
            if (costs[k][image] >= kNever) continue;
            const std::uint32_t change =
                k + 1 < scans.size()
                    ? kChange * static_cast<std::uint32_t>(std::popcount(image ^ unsigned{images[k + 1]}))
                    : 0;
            if (costs[k][image] + change < best) {
                best = costs[k][image] + change;
                images[k] = static_cast<std::uint8_t>(image);
            }
        }
    }
    return images;
}

/// Times with `later - sooner >= least`, found by letting each be as early as it can.
class Times {
  public:
    explicit Times(std::size_t count) : at_(count) {}

    std::size_t add() {
        at_.push_back(0);
        return at_.size() - 1;
    }
    void at_least(std::size_t sooner, std::size_t later, std::int64_t least) {
        bounds_.push_back({sooner, later, least});
    }
    void at_most(std::size_t sooner, std::size_t later, std::int64_t most) { at_least(later, sooner, -most); }

    bool solve() {
        for (std::size_t round = 0; round <= at_.size(); ++round) {
            bool changed = false;
            for (const Bound& b : bounds_) {
                if (at_[b.later] - at_[b.sooner] >= b.least) continue;
                at_[b.later] = at_[b.sooner] + b.least;
                changed = true;
            }
            if (!changed) return true;
        }
        return false;
    }
    std::int64_t operator[](std::size_t i) const { return at_[i]; }

  private:
    struct Bound {
        std::size_t sooner;
        std::size_t later;
        std::int64_t least;
    };
    std::vector<std::int64_t> at_;
    std::vector<Bound> bounds_;
};

/// Time k is that of scan k; the last one that of the scan that would follow.
void bound_delays(Times& times, std::span<const CourseScan> scans) {
    for (std::size_t k = 0; k < scans.size(); ++k) {
        times.at_least(k, k + 1, scans[k].delay.least);
        if (scans[k].delay.most < kEndless) times.at_most(k, k + 1, scans[k].delay.most);
    }
}

/// Repeated scans see the timer end too: they are `most_idle` apart.
void bound_timer(Times& times, std::span<const CourseScan> scans, bool paced,
                 std::span<const ChosenPreset> presets) {
    std::size_t preset_at = 0;
    std::int64_t preset = 0;
    for (std::size_t k = 0; k < scans.size(); ++k) {
        if (preset != 0) {
            if (scans[k].place.runs) {
                times.at_most(preset_at, k, preset - 1);
            } else {
                times.at_least(preset_at, k, preset);
                preset = 0;
            }
        }
        const bool runs_on = preset != 0 && scans[k].place.runs;
        if (paced && runs_on && scans[k].idle)
            times.at_most(preset_at, k + 1, preset - 1 + Machine::kMostIdle);
        if (scans[k].group->pending.timer_preset == 0) continue;
        preset = chosen_value(presets, scans[k].group->pending.timer_preset);
        preset_at = k;
    }
}

/// A scan that sees a move to a place neither ended nor disturbed is no later than it takes. Repeated ones
/// are none either.
void bound_moves(Times& times, std::span<const CourseScan> scans, std::uint32_t move_ms, bool paced) {
    std::size_t ordered = 0;
    for (std::size_t k = 0; k < scans.size(); ++k) {
        const Group& group = *scans[k].group;
        if (scans[k].place.motion == Motion::to_place && !group.in_pos && !group.disturbs) {
            times.at_most(ordered, k, move_ms);
            if (paced && scans[k].idle) times.at_most(ordered, k + 1, move_ms + Machine::kMostIdle);
        }
        if (begins_move(group.orders)) ordered = k;
    }
}

/// An input that a scan sees changed did so after the scan before, and not before it was steady.
void bound_inputs(Times& times, std::span<const CourseScan> scans, const Images& images,
                  const std::array<std::uint32_t, 6>& stable_ms) {
    for (unsigned input = 0; input < stable_ms.size(); ++input) {
        const unsigned bit = 1U << input;
        if (stable_ms[input] == 0) continue;
        std::optional<std::size_t> before;
        for (std::size_t k = 1; k < images.size(); ++k) {
            if (((images[k] ^ images[k - 1]) & bit) == 0) continue;
            const std::size_t change = times.add();
            times.at_least(k - 1, change, -std::int64_t{scans[k - 1].group->delay.end});
            times.at_least(change, k, 0);
            if (before) times.at_least(*before, change, stable_ms[input]);
            before = change;
        }
    }
}

/// Repeats idle scans where time passes, so that no two are further apart than the gateway's.
Course lay_out(std::span<const CourseScan> scans, const Images& images, const Times& times, bool paced) {
    Course course;
    for (std::size_t k = 0; k < scans.size(); ++k) {
        PlayedScan scan;
        scan.image = images[k];
        std::int64_t rest = times[k + 1] - times[k];
        while (paced && scans[k].idle && rest > Machine::kMostIdle) {
            scan.dt_ms = rest % Machine::kMostIdle != 0 ? 1 : Machine::kMostIdle;
            course.push_back(scan);
            scan.repeats = true;
            rest -= scan.dt_ms;
        }
        scan.dt_ms = static_cast<std::uint32_t>(rest);
        course.push_back(scan);
    }
    return course;
}

/// Plays the course on the engine itself; false if it does not go as the explorer thought.
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

std::optional<Course> realize(const Realization& how, std::span<const CourseScan> scans,
                              const std::optional<Overdue>& overdue) {
    if (scans.empty()) return Course{};
    const Images images = calm_images(scans);
    Times times(scans.size() + 1);
    bound_delays(times, scans);
    const bool driver = how.assume == Assume::driver;
    bound_timer(times, scans, driver, how.presets);
    if (how.move_ms != 0) bound_moves(times, scans, how.move_ms, driver);
    bound_inputs(times, scans, images, how.stable_ms);
    if (overdue) times.at_least(overdue->from, overdue->to, std::int64_t{overdue->more_than_ms} + 1);
    if (!times.solve()) return std::nullopt;
    Course course = lay_out(scans, images, times, driver);
    if (!play(how.table, scans, course)) return std::nullopt;
    return course;
}

}  // namespace nplc::verify
