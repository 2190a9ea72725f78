#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "place.h"

namespace nplc::verify {

class Explorer;

struct Precision {
    bool times_timer = false;      ///< else it may end at any time
    bool knows_lost_link = false;  ///< else a lost link is any ERROR
    bool keeps_edges = false;      ///< for ways back and courses
    /// While a scan reads ERROR a lost link may be restored; the gateway then stops the motor before it
    /// scans. False excludes courses, so that no proof is possible.
    bool waits_for_line = true;
    const Property* deadline = nullptr;  ///< a WHENEVER or a NEVER .. WHILE to be broken
    std::size_t most_states = 2'000'000;
    /// Limits the exploration to nodes from which the first target can be reached, nearest first: an
    /// exploration without times, and for each of its nodes the number of scans to the end of such a scan.
    const Explorer* guide = nullptr;
    const std::vector<std::uint32_t>* distances = nullptr;
};
/// A distance that is none: there is no way.
inline constexpr std::uint32_t kFar = ~std::uint32_t{0};

/// What a scan makes of a place: inputs, timer, counter, the motor and the times of them.
class Successors {
  public:
    Successors(const Machine& machine, const Precision& precision);

    const Machine& machine() const { return machine_; }
    const Precision& precision() const { return precision_; }
    /// Places differ in their times, which a zone holds.
    bool uses_zones() const { return uses_zones_; }
    /// A NEVER .. WHILE is to be broken, not a WHENEVER.
    bool is_hold() const {
        return precision_.deadline != nullptr && precision_.deadline->form == Form::never_while;
    }
    /// The images with which a scan that begins there is possible.
    const ImageSet& allowed(const Place& place) const {
        return allowed_[static_cast<std::size_t>(place.motor)];
    }
    /// A move to a place is timed.
    bool times_move(const Place& place) const { return times_moves_ && is_timed(place.motion); }
    /// A move has taken longer than any may.
    bool is_late(const Zone& zone) const { return times_moves_ && zone.moved.least > longest_move(); }

    /// The place after a scan of a group, before any time passes; the motor is unchanged.
    Place landing(const Place& here, const Group& group) const {
        sequencer::State state{here.step, here.outputs, std::uint16_t{here.runs}, here.counter};
        group.outcome.apply(state);
        Place to = here;
        to.step = state.step;
        to.outputs = state.outputs;
        to.runs = state.timer != 0;
        to.counter = state.counter;
        to.motion = motion_of(here, group);
        return to;
    }
    /// It has no effect.
    bool is_idle(const Place& place, const Group& group) const {
        return !group.outcome.sends() && group.outcome.timer == 0 &&
               landing(place, group).packed() == place.packed();
    }
    /// The place right after the scan; the motor as the images' ERROR leaves it, not lost.
    Place after(const Place& place, const Group& group) const {
        Place next = landing(place, group);
        next.motor = group.error && !group.resets_error ? Place::Motor::error : Place::Motor::free;
        next.pending = false;
        return next;
    }
    /// To the scan after it, which begins in `next`.
    Bounds delay_of(const Place& place, const Group& group, const Place& next) const {
        if (machine_.assume() == Assume::any) return {0, kEndless};
        if (is_idle(place, group)) return {0, kEndless};
        const auto most = static_cast<std::int32_t>(group.delay.most);
        if (may_wait_for_line(next.motor)) return {0, most + kUntilLost};
        if (group.error || group.delay.least < group.delay.end) return {0, most};
        return {static_cast<std::int32_t>(group.delay.least - group.delay.end), most};
    }
    /// The images of a scan after which `next` can be.
    static ImageSet narrowed(const ImageSet& images, const Place& next) {
        return next.motor == Place::Motor::lost ? images & images_of_lost_link() : images;
    }

    /// Without times: the possible next states of the motor, as bits.
    std::uint8_t next_motors(const Place& place, const Group& group) const {
        return next_motors_[group.number][static_cast<std::size_t>(place.motor)];
    }
    /// Calls `each` for every count that a range of counts stands for, where scans count down.
    template <class Each>
    void each_count(Place to, const Each& each) const {
        const PresetRange* const range =
            machine_.counts_down_in(to.step) ? machine_.counts_of(to.counter) : nullptr;
        if (range == nullptr) return each(to);
        for (std::uint32_t count = range->least; count <= range->most; ++count) {
            to.counter = static_cast<std::uint16_t>(count);
            each(to);
        }
    }

    /// Some of a scan's images, by what they do to the deadline.
    struct Part {
        ImageSet images;
        bool begins = false;
        bool pending = false;
    };
    using Parts = std::array<Part, 2>;
    Parts parts(const Place& place, const View& view, const ImageSet& images) const;
    /// Calls `take(place, zone)` for each place where the next scan may begin; `misses` becomes true if the
    /// deadline may have passed by then.
    template <class Each>
    void each(const Place& place, const Zone& zone, const Group& group, const Part& part, Each&& take,
              bool& misses) const;
    bool ends_late(const Zone& zone, const Group& group) const;
    bool keeps_too_long(const Place& place, const Zone& zone, const Group& group, const View& view,
                        const ImageSet& images) const;

  private:
    /// By this time a failed line is reported as lost, whatever was pending.
    static constexpr std::int32_t kUntilLost = 300;

    void find_next_motors();
    /// After a scan of the group.
    Motion motion_of(const Place& place, const Group& group) const {
        if (!machine_.tells_motion()) return Motion::none;
        return motion_after(place.motion, {group.in_pos, group.disturbs}, group.outcome.orders);
    }
    /// Whether the scan after this motor state may be delayed until a lost link is detected.
    bool may_wait_for_line(Place::Motor motor) const {
        return motor == Place::Motor::cut || (precision_.waits_for_line && motor != Place::Motor::free);
    }
    /// Between repeated scans.
    std::int32_t most_idle(Place::Motor motor) const {
        return std::int32_t{Machine::kMostIdle} + (may_wait_for_line(motor) ? kUntilLost : 0);
    }
    std::int32_t longest_move() const { return static_cast<std::int32_t>(machine_.move_ms()); }

    const Machine& machine_;
    Precision precision_;
    bool uses_zones_;
    bool times_moves_;
    std::array<ImageSet, 4> allowed_;  ///< by what the motor is
    /// By group and state of the motor: the possible next states of the motor, as bits.
    std::vector<std::array<std::uint8_t, 4>> next_motors_;
};

template <class Each>
void Successors::each(const Place& place, const Zone& zone, const Group& group, const Part& part, Each&& take,
                      bool& misses) const {
    const Place next = after(place, group);
    Zone now = zone;
    if (part.begins || (place.pending && !part.pending)) now.begin_deadline();
    const bool moves = times_moves_ && is_timed(next.motion);
    if (times_moves_ && (!moves || begins_move(group.outcome.orders))) now.begin_move();
    if (group.outcome.timer != 0 && precision_.times_timer) {
        const PresetRange times = machine_.times_of(group.outcome.timer);
        now.preset(times.least, times.most);
    }
    const auto let_pass = [&](Place to) {
        if (!narrowed(part.images, to).any() || allowed(to).none()) return;
        to.pending = part.pending;
        if (!uses_zones_) {
            if (next.runs) take(to, now);
            to.runs = false;
            take(to, now);
            return;
        }
        const Bounds delay = delay_of(place, group, to);
        Zone later = now;
        later.elapse(delay, part.pending, moves);
        if (delay.most >= kEndless && machine_.assume() == Assume::driver) {
            // Scans repeat meanwhile, and the first with a new image is not idle
            if (precision_.times_timer && next.runs)
                later.left.least = std::max(later.left.least, 1 - most_idle(next.motor));
            if (moves) later.moved.most = std::min(later.moved.most, longest_move() + most_idle(next.motor));
            later.tighten(times_moves_);
        }
        if (part.pending) {
            const auto limit = static_cast<std::int32_t>(precision_.deadline->within_ms);
            if (!is_hold()) {
                if (later.passed.most > limit) misses = true;
                later.passed.most = std::min(later.passed.most, limit);
            }
        }
        const auto hand_out = [&](bool runs, bool is_over, bool is_late) {
            Zone there = later;
            if (is_late) {
                there.moved.least = std::max(there.moved.least, longest_move() + 1);
            } else if (moves) {
                there.moved.most = std::min(there.moved.most, longest_move());
            }
            if (is_hold() && part.pending) {
                const auto limit = static_cast<std::int32_t>(precision_.deadline->within_ms);
                if (is_over) {
                    there.passed.least = std::max(there.passed.least, limit);
                } else {
                    there.passed.most = std::min(there.passed.most, limit - 1);
                }
            }
            if (precision_.times_timer && next.runs) {
                if (runs) {
                    there.left.least = std::max(there.left.least, 1);
                } else {
                    there.left.most = std::min(there.left.most, 0);
                }
            } else {
                there.stop_timer();
            }
            there.tighten(times_moves_);
            if (there.empty()) return;
            if (!runs) there.stop_timer();
            if (is_over) there.cut_passed(static_cast<std::int32_t>(precision_.deadline->within_ms));
            if (is_late) there.cut_moved(longest_move() + 1);
            to.runs = runs;
            take(to, there);
        };
        for (const bool is_late : {false, true}) {
            if (is_late && !moves) continue;
            for (const bool is_over : {false, true}) {
                if (is_over && !(is_hold() && part.pending)) continue;
                if (next.runs) hand_out(true, is_over, is_late);
                hand_out(false, is_over, is_late);
            }
        }
    };
    const bool stays_lost = place.motor == Place::Motor::lost && next.motor == Place::Motor::error;
    if (!stays_lost) let_pass(next);
    if (machine_.assume() == Assume::any) return;
    if (next.motor == Place::Motor::error && precision_.knows_lost_link &&
        place.motor != Place::Motor::error) {
        Place lost = next;
        lost.motor = Place::Motor::lost;
        let_pass(lost);
    }
    if (next.motor == Place::Motor::free && group.outcome.sends()) {
        Place cut = next;
        cut.motor = Place::Motor::cut;
        let_pass(cut);
    }
}

}  // namespace nplc::verify
