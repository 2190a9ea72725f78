#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sequencer/state.h"
#include "sequencer/table.h"
#include "verify/property.h"

/// A table worked out for exploring: in each step, what a scan does under each set of images.
namespace nplc::verify {

enum class Assume : std::uint8_t {
    any,     ///< inputs, INPOS, ERROR and the time between scans are free
    driver,  ///< what the gateway and a real motor can do
};

/// Of a scan that sends, in milliseconds from its beginning: when the next one can begin, and when at the
/// latest it ends, for it waits while the motor's queue is full.
struct Delay {
    std::uint32_t least = 0;
    std::uint32_t most = 0;
    std::uint32_t end = 0;
    bool operator==(const Delay&) const = default;
};

/// How long orders keep the motor's line, until the next scan may begin.
using OrderTime = std::function<Delay(std::span<const sequencer::MotorOrder>)>;

/// What all images of a set amount to in one step, with timer and counter zero or not.
struct Group {
    sequencer::Pending pending;
    ImageSet images;
    std::vector<sequencer::MotorOrder> orders;  ///< those of one of the images
    Delay delay;                                ///< driver only
    bool sends = false;
    bool in_pos = false;        ///< of all its images, if the machine tells motion
    bool resets_error = false;  ///< driver only: sends "reset error"
};

class Machine {
  public:
    /// Between scans without orders.
    static constexpr std::uint32_t kMostIdle = 2;

    /// `permitted` are the images that assumptions leave; `tells_motion` keeps apart what begins and ends a
    /// motion.
    Machine(const sequencer::Table& table, Assume assume, const OrderTime& order_time,
            const ImageSet& permitted = ~ImageSet{}, bool tells_motion = false);

    Assume assume() const { return assume_; }
    const ImageSet& permitted() const { return permitted_; }
    bool tells_motion() const { return tells_motion_; }
    std::span<const Group> groups(std::uint8_t step, bool timer_zero, bool counter_zero) const {
        return rows_[row_of(step, timer_zero, counter_zero)];
    }
    /// Which of `groups` an image belongs to.
    std::uint16_t group_with(std::uint8_t step, bool timer_zero, bool counter_zero,
                             std::uint8_t image) const {
        return group_with_[row_of(step, timer_zero, counter_zero)][image];
    }
    /// Numbers of the first group of a row; all groups are numbered through.
    std::size_t first_group(std::uint8_t step, bool timer_zero, bool counter_zero) const {
        return first_[row_of(step, timer_zero, counter_zero)];
    }
    std::size_t group_count() const { return group_count_; }
    std::uint16_t greatest_counter() const { return greatest_counter_; }
    std::uint64_t steps_with_terms() const { return steps_with_terms_; }
    /// Bits of HW_INP that some term compares.
    std::uint8_t cared_bits() const { return cared_bits_; }

  private:
    static std::size_t row_of(std::uint8_t step, bool timer_zero, bool counter_zero) {
        return step * 4U + (timer_zero ? 1U : 0U) + (counter_zero ? 2U : 0U);
    }
    void fill_step(const sequencer::Table& table, std::uint8_t step, const OrderTime& order_time);

    Assume assume_;
    ImageSet permitted_;
    bool tells_motion_;
    std::vector<std::vector<Group>> rows_;
    std::vector<std::array<std::uint16_t, 256>> group_with_;  ///< by row and image
    std::vector<std::size_t> first_;
    std::size_t group_count_ = 0;
    std::uint16_t greatest_counter_ = 0;
    std::uint64_t steps_with_terms_ = 0;
    std::uint8_t cared_bits_ = sequencer::kError;
};

}  // namespace nplc::verify
