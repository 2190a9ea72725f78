#pragma once

#include <algorithm>
#include <cstdint>

#include "analysis/machine.h"

namespace nplc::verify {

/// Longer than any timeout.
inline constexpr std::int32_t kEndless = 500'000'000;

struct Bounds {
    std::int32_t least = 0;
    std::int32_t most = 0;
    bool operator==(const Bounds&) const = default;
    bool empty() const { return least > most; }
    bool within(const Bounds& other) const { return least >= other.least && most <= other.most; }
    Bounds operator-() const { return {-most, -least}; }
    friend Bounds operator+(const Bounds& a, const Bounds& b) { return {a.least + b.least, a.most + b.most}; }
    friend Bounds operator-(const Bounds& a, const Bounds& b) { return a + -b; }
    void narrow(const Bounds& other) {
        least = std::max(least, other.least);
        most = std::min(most, other.most);
    }
};

/// All possible combinations, at one place, of the timer's remaining time, the time since a deadline began
/// and the duration of a move, in whole milliseconds. All change at the same rate, so sums and differences
/// describe how they depend on each other. Unused ones are 0, and all bounds are as tight as possible.
struct Zone {
    Bounds left;
    Bounds passed;
    Bounds sum;     ///< left + passed
    Bounds moved;   ///< 0 where moves are not timed
    Bounds rest;    ///< left + moved
    Bounds sooner;  ///< moved - passed
    bool operator==(const Zone&) const = default;

    bool empty() const {
        return left.empty() || passed.empty() || sum.empty() || moved.empty() || rest.empty() ||
               sooner.empty();
    }
    bool within(const Zone& other) const {
        return left.within(other.left) && passed.within(other.passed) && sum.within(other.sum) &&
               moved.within(other.moved) && rest.within(other.rest) && sooner.within(other.sooner);
    }

    /// Any time between the two, in milliseconds.
    void preset(std::int32_t least, std::int32_t most) { set_left({least, most}); }
    void stop_timer() { set_left({}); }
    void begin_deadline() { set_passed({}); }
    /// Time beyond `limit` is not distinguished.
    void cut_passed(std::int32_t limit) { set_passed({limit, limit}); }
    void begin_move() { set_moved({}); }
    /// Nor is the duration of a move beyond it.
    void cut_moved(std::int32_t limit) { set_moved({limit, limit}); }

    /// Time passes; unused values stay 0.
    void elapse(const Bounds& delay, bool pending, bool moving) {
        left = left - delay;
        if (pending) {
            passed = passed + delay;
        } else {
            sum = left;
        }
        if (moving) moved = moved + delay;
        if (moving != pending) sooner = moving ? moved : -passed;
        if (!moving) rest = left;
    }
    void tighten(bool times_moves) {
        for (int i = 0; i < 2; ++i) tighten(left, passed, sum);
        if (!times_moves) return;
        for (int i = 0; i < 4; ++i) {
            tighten(left, moved, rest);
            tighten(passed, sooner, moved);
            tighten(sum, sooner, rest);
            tighten(left, passed, sum);
        }
    }

  private:
    void set_left(const Bounds& value) {
        left = value;
        sum = passed + value;
        rest = moved + value;
    }
    void set_passed(const Bounds& value) {
        passed = value;
        sum = left + value;
        sooner = moved - value;
    }
    void set_moved(const Bounds& value) {
        moved = value;
        rest = left + value;
        sooner = value - passed;
    }
    /// a + b = c.
    static void tighten(Bounds& a, Bounds& b, Bounds& c) {
        a.narrow(c - b);
        b.narrow(c - a);
        c.narrow(a + b);
    }
};

}  // namespace nplc::verify
