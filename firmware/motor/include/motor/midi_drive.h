#pragma once

#include <cstdint>

#include "base/time.h"
#include "motor/midi_link.h"
#include "registers/midi_motor.h"

namespace nplc::motor {

/// The last reported state of a MIDI module: its parameters, status and shaft position.
class MidiDrive {
  public:
    using Model = registers::midi::Model;

    explicit MidiDrive(Model model) : model_(model) {}

    /// The answer to a query.
    void take_answer(std::uint8_t query, std::uint32_t value, base::Instant now);
    // After commands that the module has carried out.
    void set_torque(std::uint32_t torque) { torque_ = static_cast<std::uint8_t>(torque); }
    void set_tolerance(std::uint32_t tolerance) { tolerance_ = static_cast<std::uint8_t>(tolerance); }
    void set_period(std::uint32_t period) { period_ = static_cast<std::uint16_t>(period); }
    void set_ramp(std::uint32_t ramp) { ramp_ = static_cast<std::uint8_t>(ramp); }
    void set_origin() { position_at_ = {}; }

    Model model() const { return model_; }
    std::uint32_t status() const { return status_; }
    bool trips() const { return (status_ & registers::midi::kTrips) != 0; }
    bool at_end_stop() const;
    bool is_busy() const { return !not_busy_; }
    /// The reference input was active in at least one of the last eight measures.
    bool was_referenced() const { return referenced_ != 0; }

    std::int32_t position() const { return position_; }  ///< increments
    std::int32_t position_before() const { return position_before_; }
    std::int32_t moved() const {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(position_) -
                                         static_cast<std::uint32_t>(position_before_));
    }
    std::int32_t counts() const;  ///< in counts of a JVL motor
    /// Counts a sample of a JVL motor, from the last two positions if they are close enough.
    std::int32_t speed() const;

    std::uint8_t most_torque() const { return most_torque_; }
    std::uint8_t torque() const { return torque_; }
    std::uint8_t tolerance() const { return tolerance_; }
    std::uint8_t ramp() const { return ramp_; }
    std::uint8_t unstall() const { return unstall_; }
    std::uint16_t period() const { return period_; }

  private:
    Model model_;
    bool not_busy_ = false;
    std::uint8_t referenced_ =
        0;  ///< history of the reference input over the last eight measures, the latest in bit 0
    std::uint8_t most_torque_ = registers::midi::kMostTorque;  ///< Imax
    std::uint8_t unstall_ = 0;
    std::uint8_t ramp_ = 0;
    std::uint8_t torque_ = 0;
    std::uint8_t tolerance_ = 0;
    std::uint16_t period_ = 0;
    std::uint32_t status_ = 0;
    std::int32_t position_ = 0;
    std::int32_t position_before_ = 0;
    base::Instant position_at_{};
    base::Microseconds position_step_{};  ///< time between the last two positions
};

}  // namespace nplc::motor
