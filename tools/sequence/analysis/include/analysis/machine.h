#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "analysis/property.h"
#include "sequencer/table.h"
#include "table/step.h"

/// A table prepared for exploration: for each step, the effect of a scan for each set of images.
namespace nplc::verify {

enum class Assume : std::uint8_t {
    any,     ///< inputs, INPOS, ERROR and the time between scans are free
    driver,  ///< what the gateway and a real motor can produce
};

/// Times of a scan that sends, in milliseconds from its beginning: the earliest and latest beginning of the
/// next scan, and its latest end, since it waits while the motor's queue is full.
struct Delay {
    std::uint32_t least = 0;
    std::uint32_t most = 0;
    std::uint32_t end = 0;
    bool operator==(const Delay&) const = default;
};

/// How long orders keep the motor's line, until the next scan may begin.
using OrderTime = std::function<Delay(std::span<const sequencer::MotorOrder>)>;

/// A preset of the timer or of the counter that represents each value of a range, such as of a set-point. No
/// other term presets `value`.
struct PresetRange {
    std::uint16_t value = 0;
    std::uint16_t least = 0;
    std::uint16_t most = 0;
};

struct PresetRanges {
    std::vector<PresetRange> timer;
    std::vector<PresetRange> counter;  ///< each `value` above all that the counter can be
};

/// The common effect of all images of a set in one step, with timer and counter zero or not.
struct Group {
    std::uint32_t number = 0;  ///< among all of the machine
    table::Outcome outcome;    ///< with the orders of one of the images
    ImageSet images;
    Delay delay;                ///< driver only
    bool error = false;         ///< driver only: in all its images, else in none
    bool in_pos = false;        ///< of all its images, if the machine tracks motion
    bool disturbs = false;      ///< ERROR in all its images, if the machine times moves
    bool resets_error = false;  ///< driver only: sends "reset error"
};

class Machine {
  public:
    /// Between scans without orders.
    static constexpr std::uint32_t kMostIdle = 2;

    /// `permitted` are the images that assumptions leave; `tells_motion` keeps apart what begins and ends a
    /// motion; so does `move_ms`, within which a move to a place ends (0: whenever it likes).
    Machine(const sequencer::Table& table, Assume assume, const OrderTime& order_time,
            const ImageSet& permitted = ~ImageSet{}, bool tells_motion = false, std::uint32_t move_ms = 0,
            PresetRanges ranges = {});

    Assume assume() const { return assume_; }
    /// The times that a preset can represent.
    PresetRange times_of(std::uint16_t preset) const {
        const PresetRange* const range = range_of(preset, ranges_.timer);
        return range != nullptr ? *range : PresetRange{preset, preset, preset};
    }
    const PresetRanges& ranges() const { return ranges_; }
    bool has_counter_ranges() const { return !ranges_.counter.empty(); }
    /// The counts that a counter value can represent; nullptr if it is a plain count.
    const PresetRange* counts_of(std::uint16_t counter) const { return range_of(counter, ranges_.counter); }
    /// Some scan of the step counts down: there a counter's range is split into its counts.
    bool counts_down_in(std::uint8_t step) const { return ((steps_that_count_ >> step) & 1U) != 0; }
    const ImageSet& permitted() const { return permitted_; }
    bool tells_motion() const { return tells_motion_; }
    /// Milliseconds after which a move to a place has ended; 0 for never.
    std::uint32_t move_ms() const { return move_ms_; }
    std::span<const Group> groups(std::uint8_t step, bool timer_zero, bool counter_zero) const {
        const std::size_t row = row_of(step, timer_zero, counter_zero);
        return std::span(groups_).subspan(first_[row], first_[row + 1] - first_[row]);
    }
    std::span<const Group> all_groups() const { return groups_; }
    const Group& group(std::uint32_t number) const { return groups_[number]; }
    /// The group that an image belongs to.
    const Group& group_with(std::uint8_t step, bool timer_zero, bool counter_zero, std::uint8_t image) const {
        return groups_[group_with_[row_of(step, timer_zero, counter_zero)][image]];
    }
    std::uint16_t greatest_counter() const { return greatest_counter_; }
    std::uint64_t steps_with_terms() const { return steps_with_terms_; }
    /// Bits of HW_INP that some term compares.
    std::uint8_t cared_bits() const { return cared_bits_; }

  private:
    static const PresetRange* range_of(std::uint16_t preset, const std::vector<PresetRange>& ranges) {
        for (const PresetRange& range : ranges) {
            if (range.value == preset) return &range;
        }
        return nullptr;
    }
    static std::size_t row_of(std::uint8_t step, bool timer_zero, bool counter_zero) {
        return step * 4U + (timer_zero ? 1U : 0U) + (counter_zero ? 2U : 0U);
    }
    void fill_row(const table::Step& step, const std::vector<std::size_t>& kinds, unsigned zeros,
                  const OrderTime& order_time);
    void add_group(const table::Outcome& outcome, unsigned told, const OrderTime& order_time);

    Assume assume_;
    ImageSet permitted_;
    bool tells_motion_;
    std::uint32_t move_ms_;
    PresetRanges ranges_;
    std::vector<Group> groups_;                               ///< row by row
    std::vector<std::size_t> first_;                          ///< of each row, and the end
    std::vector<std::array<std::uint16_t, 256>> group_with_;  ///< by row and image
    std::uint16_t greatest_counter_ = 0;
    std::uint64_t steps_with_terms_ = 0;
    std::uint64_t steps_that_count_ = 0;
    std::uint8_t cared_bits_ = sequencer::kError;
};

}  // namespace nplc::verify
