#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "sim/pulse_input.h"

namespace nplc::sim {

/// A switch at the axis: 10 V on one side of a place, 0 V on the other.
struct PositionSensor {
    std::int64_t counts = 0;  ///< of the shaft, as Plant counts them
    bool on_above = true;     ///< else on below
};

/// What is wired to the motor's analogue input and, where the pins are free for it, to its pulse input.
class Terminals {
  public:
    /// A voltage for good: takes a sensor off.
    void set_analogue(std::int32_t millivolts);
    void connect(const PositionSensor& sensor) { sensor_ = sensor; }
    std::int32_t millivolts(std::int64_t shaft_counts) const {
        return sensor_ ? sensed(shaft_counts) : millivolts_;
    }

    /// Counts a second at the pulse input (all edges of a quadrature signal), negative backwards. At most a
    /// million either way.
    void set_pulse_rate(std::int32_t per_second, PulseFormat format = PulseFormat::quadrature);
    /// The whole counts that `input` makes of the next `period`; fractions are kept.
    std::int32_t next_pulses(std::chrono::nanoseconds period, const PulseInput& input) {
        return pulse_rate_ == 0 ? 0 : pulses(period, input);
    }

  private:
    std::int32_t sensed(std::int64_t shaft_counts) const;
    std::int32_t pulses(std::chrono::nanoseconds period, const PulseInput& input);

    std::int32_t millivolts_ = 0;
    std::optional<PositionSensor> sensor_;
    std::int64_t pulse_rate_ = 0;
    PulseFormat pulse_format_ = PulseFormat::quadrature;
    std::int64_t fraction_ = 0;  // 1/1'000'000'000 of a count
};

}  // namespace nplc::sim
