#include "motor/midi_drive.h"

#include <algorithm>

namespace nplc::motor {
namespace {

namespace midi = registers::midi;

constexpr base::Microseconds kLongestStep{500'000};
constexpr std::int32_t kSample = 1'920;  ///< us, of a MAC50-141
constexpr std::int32_t kMostCounts = INT32_MAX / kSample;
constexpr std::uint32_t kStops =
    midi::kAtUpperInput | midi::kAtLowerInput | midi::kAtUpperStop | midi::kAtLowerStop;

}  // namespace

void MidiDrive::take_answer(std::uint8_t query, std::uint32_t value, base::Instant now) {
    switch (query) {
        case midi::GET_STATUS:
            status_ = value;
            return;
        case midi::GET_MEASURES:
            not_busy_ = (value & midi::kNotBusy) != 0;
            referenced_ =
                static_cast<std::uint8_t>(unsigned{referenced_} << 1 | (value / midi::kReferenceInput & 1));
            return;
        case midi::GET_POSITION:
            position_before_ = position_;
            position_step_ = now - position_at_;
            position_ = static_cast<std::int32_t>(value);
            position_at_ = now;
            return;
        case midi::GET_SPEEDS:
            period_ = static_cast<std::uint16_t>(value);
            unstall_ = static_cast<std::uint8_t>(value >> 24);
            return;
        case midi::GET_SETTINGS:
            ramp_ = static_cast<std::uint8_t>(value >> 24);
            torque_ = static_cast<std::uint8_t>(value >> 16);
            tolerance_ = static_cast<std::uint8_t>(value);
            return;
        default:
            most_torque_ = static_cast<std::uint8_t>(value >> 24);
            if (most_torque_ == 0) most_torque_ = midi::kMostTorque;
            return;
    }
}

bool MidiDrive::at_end_stop() const {
    return (status_ & kStops) != 0;
}

std::int32_t MidiDrive::counts() const {
    return midi::counts_of_increments(model_, position_);
}

std::int32_t MidiDrive::speed() const {
    if (position_step_ <= base::Microseconds(0) || position_step_ > kLongestStep) return 0;
    const std::int32_t counts =
        std::clamp(midi::counts_of_increments(model_, moved()), -kMostCounts, kMostCounts);
    const std::int32_t a_sample = counts * kSample / static_cast<std::int32_t>(position_step_.count());
    return std::clamp<std::int32_t>(a_sample, INT16_MIN, INT16_MAX);
}

}  // namespace nplc::motor
