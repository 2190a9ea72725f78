#include "sim/midi_profile.h"

#include <algorithm>

namespace nplc::sim {
namespace {

constexpr int kRampSteps = 15;

/// Increments of the ramp's first `step` steps, in units of AA.
constexpr std::int64_t up_to(int step) {
    return static_cast<std::int64_t>(step) * (step + 1) / 2;
}
static_assert(up_to(kRampSteps) == 120);

}  // namespace

void MidiProfile::begin_move(std::int64_t increments, std::uint16_t period, std::uint8_t ramp) {
    *this = {};
    kind_ = increments > 0 ? Kind::move : Kind::none;
    ramp_ = ramp;
    period_ = period;
    remaining_ = increments;
}

void MidiProfile::begin_segment(std::int64_t increments, std::uint16_t period) {
    *this = {};
    kind_ = increments > 0 ? Kind::segment : Kind::none;
    period_ = period;
    remaining_ = increments;
}

void MidiProfile::begin_run(std::uint16_t period, std::uint8_t ramp) {
    if (kind_ != Kind::run) *this = {};
    kind_ = Kind::run;
    ramp_ = ramp;
    begin_ramp({period, 1});
}

/// From the present speed, as whole ticks.
void MidiProfile::begin_ramp(Pace to) {
    const Pace now = run_pace();
    from_ = now.denominator == 0 ? Pace{} : Pace{(now.numerator + now.denominator / 2) / now.denominator, 1};
    to_ = to;
    run_step_ = ramp_ == 0 ? kSteps : 1;
    in_step_ = 0;
}

void MidiProfile::stop() {
    if (kind_ == Kind::segment) clear();
    if (kind_ == Kind::move) set_remaining(0);
    if (kind_ != Kind::run) return;
    begin_ramp({});
    if (run_step_ == kSteps || done_ == 0) clear();
}

void MidiProfile::set_remaining(std::int64_t increments) {
    remaining_ = std::max(increments, std::min(remaining_, stopping_distance()));
    if (remaining_ == 0) clear();
}

/// The step, 1..16, of an increment with so many before it.
int MidiProfile::step_after(std::int64_t increments) const {
    int step = 1;
    while (step <= kRampSteps && increments >= ramp_ * up_to(step)) ++step;
    return step;
}

std::int64_t MidiProfile::stopping_distance() const {
    const int step = std::min(step_after(done_), step_after(remaining_ - 1));
    return done_ == 0 ? 0 : ramp_ * up_to(std::min(step, kRampSteps));
}

MidiProfile::Pace MidiProfile::run_pace() const {
    const Pace both{from_.numerator * to_.numerator, 1};
    const Ticks speed = (kSteps - run_step_) * from_.denominator * to_.numerator +
                        run_step_ * to_.denominator * from_.numerator;
    return {kSteps * both.numerator, speed};
}

MidiProfile::Pace MidiProfile::pace() const {
    if (kind_ == Kind::segment) return {period_, 1};
    if (kind_ == Kind::run) return run_pace();
    return {Ticks{kSteps} * period_, std::min(step_after(done_), step_after(remaining_ - 1))};
}

MidiProfile::Ticks MidiProfile::interval() const {
    const auto [numerator, denominator] = pace();
    const Ticks carried = denominator == carried_for_ ? carried_ : 0;
    return (numerator + carried) / denominator;
}

void MidiProfile::advance() {
    const auto [numerator, denominator] = pace();
    const Ticks carried = denominator == carried_for_ ? carried_ : 0;
    last_ = (numerator + carried) / denominator;
    carried_ = (numerator + carried) % denominator;
    carried_for_ = denominator;
    ++done_;
    if (kind_ != Kind::run) {
        if (--remaining_ == 0) clear();
        return;
    }
    if (run_step_ == kSteps) return;
    // Faster: short steps first; slower: the same backwards.
    const bool slower = from_.denominator * to_.numerator > to_.denominator * from_.numerator;
    const int length = slower ? kSteps - run_step_ : run_step_;
    if (++in_step_ < std::int64_t{ramp_} * length) return;
    in_step_ = 0;
    ++run_step_;
    if (run_step_ == kSteps && to_.denominator == 0) clear();
}

}  // namespace nplc::sim
