#pragma once

#include <cstdint>

#include "analysis/machine.h"
#include "motor_orders.h"
#include "zone.h"

namespace nplc::verify {

/// The start of a scan: the table's state with the timer running or not, and the possible motor states.
struct Place {
    enum class Motor : std::uint8_t {
        free,
        error,
        lost,
        cut,  ///< driver: this scan sees an ERROR that cut the orders before it short
    };

    std::uint8_t step = 0;
    std::uint8_t outputs = 0;
    bool runs = false;  ///< the timer
    Motor motor = Motor::free;
    bool pending = false;          ///< a deadline runs
    Motion motion = Motion::none;  ///< if the machine models motion
    std::uint16_t counter = 0;

    /// Without the counter; below 1 << kPlainBits if there is no deadline and no motion is tracked.
    std::uint32_t packed_plain() const {
        return step | (unsigned{outputs} << 6U) | (runs ? 1U << 10U : 0U) |
               (static_cast<unsigned>(motor) << 11U) | (pending ? 1U << 13U : 0U) |
               (static_cast<unsigned>(motion) << 14U);
    }
    static constexpr unsigned kPlainBits = 13;
    std::uint64_t packed() const { return packed_plain() | (std::uint64_t{counter} << 18U); }
    View view() const { return {step, outputs, !runs, counter == 0, is_moving(motion)}; }
};

/// A scan of a course: its start, its actions, and the images that can cause it.
struct CourseScan {
    Place place;
    const Group* group = nullptr;
    ImageSet images;
    View view;                  ///< after it
    std::uint16_t counter = 0;  ///< after it
    Bounds delay;               ///< to the next scan
    bool idle = false;          ///< no effect: it may be repeated with the same image
    bool next_runs = false;     ///< the timer, when the next scan begins
    bool begins = false;        ///< a deadline, with this scan
};

inline const ImageSet& images_of_error() {
    return images_with_bit(7);
}
inline ImageSet images_of_lost_link() {
    return images_with_bit(7) & ~images_with_bit(6);
}

/// All that decides whether a scan of a group is of a target, below kSurroundings; `view` is the one after
/// it.
inline std::size_t surroundings_of(const Place& here, const Group& group, const View& view) {
    return (group.outcome.outputs ? 0U : here.outputs) | (view.timer_zero ? 16U : 0U) |
           (view.counter_zero ? 32U : 0U) | (static_cast<unsigned>(here.motor) << 6U) |
           (view.moving ? 256U : 0U);
}
inline constexpr std::size_t kSurroundings = 512;

}  // namespace nplc::verify
