#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "course.h"

namespace nplc::soak {

/// The line to the motor and the motor's supply, as the disturbances have set them.
class LineState {
  public:
    /// True: the line is whole again.
    bool cut(bool cut, Time now) {
        const bool is_back = is_cut_ && !cut;
        is_cut_ = cut;
        note_reach(now);
        return is_back;
    }
    /// True: the motor is on again.
    bool power(bool on, Time now) {
        const bool is_back = is_motor_off_ && on;
        is_motor_off_ = !on;
        note_reach(now);
        // It begins with rapid communication, where every damaged character is another command.
        if (on && damage_ > 0) excuses_ = true;
        return is_back;
    }
    /// Share of the characters; no value: as before.
    void spoil(std::optional<double> damage) { damage_ = damage.value_or(damage_); }

    bool is_unreachable_for(Time span, Time now) const {
        return unreachable_since_ && now - *unreachable_since_ > span;
    }
    /// A damage that no repeat shows has occurred, and the line has been bad since. `alike`: such damages so
    /// far.
    bool excuses_orders(std::uint64_t alike) {
        const bool is_new = std::exchange(alike_, alike) != alike;
        if (!is_new && !excuses_) return false;
        excuses_ = damage_ > 0;
        return true;
    }

  private:
    void note_reach(Time now) {
        const bool is_unreachable = is_cut_ || is_motor_off_;
        if (!is_unreachable) unreachable_since_.reset();
        if (is_unreachable && !unreachable_since_) unreachable_since_ = now;
    }

    std::optional<Time> unreachable_since_;
    bool is_cut_ = false;
    bool is_motor_off_ = false;
    double damage_ = 0;
    bool excuses_ = false;
    std::uint64_t alike_ = 0;
};

}  // namespace nplc::soak
