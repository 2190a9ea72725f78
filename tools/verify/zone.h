#pragma once

#include <algorithm>
#include <cstdint>

#include "verify/machine.h"

namespace nplc::verify {

/// Longer than anything that is waited for.
inline constexpr std::int32_t kEndless = 500'000'000;

struct Bounds {
    std::int32_t least = 0;
    std::int32_t most = 0;
    bool operator==(const Bounds&) const = default;
    bool empty() const { return least > most; }
    bool within(const Bounds& other) const { return least >= other.least && most <= other.most; }
};

/// All pairs of what is left of the timer and what has passed of a deadline that can be at one place, in
/// whole milliseconds. Both run with the same time, so their sum says how they belong together. What is not
/// in use is 0, and all bounds are as tight as they can be.
struct Zone {
    Bounds left;
    Bounds passed;
    Bounds sum;
    bool operator==(const Zone&) const = default;

    bool empty() const { return left.empty() || passed.empty() || sum.empty(); }
    bool within(const Zone& other) const {
        return left.within(other.left) && passed.within(other.passed) && sum.within(other.sum);
    }

    void preset(std::int32_t milliseconds) {
        left = {milliseconds, milliseconds};
        sum = {passed.least + milliseconds, passed.most + milliseconds};
    }
    /// What has passed beyond `limit` makes no difference.
    void cut_passed(std::int32_t limit) {
        passed = {limit, limit};
        sum = {left.least + limit, left.most + limit};
    }
    void begin_deadline() {
        passed = {};
        sum = left;
    }
    void stop_timer() {
        left = {};
        sum = passed;
    }
    /// Time passes; a deadline that is not `pending` stays 0.
    void elapse(const Bounds& delay, bool pending) {
        left = {left.least - delay.most, left.most - delay.least};
        if (pending) {
            passed = {passed.least + delay.least, passed.most + delay.most};
        } else {
            sum = left;
        }
    }
    void tighten() {
        for (int i = 0; i < 2; ++i) {
            left = {std::max(left.least, sum.least - passed.most),
                    std::min(left.most, sum.most - passed.least)};
            passed = {std::max(passed.least, sum.least - left.most),
                      std::min(passed.most, sum.most - left.least)};
            sum = {std::max(sum.least, left.least + passed.least),
                   std::min(sum.most, left.most + passed.most)};
        }
    }
};

}  // namespace nplc::verify
