#pragma once

#include <cstdint>
#include <optional>

namespace nplc::sim {

/// The shaft of a MIDI module with its load, in increments. The motor turns it within its torque; a load
/// above the motor's torque drags it, and without supply it coasts.
class MidiShaft {
  public:
    static constexpr int kDragSteps = 4'000;  ///< per second: update rate of a slipping shaft
    /// rpm. R: no manual has a limit of a shaft that slips; the virtual JVL motors' own.
    static constexpr int kFastest = 31'250;

    MidiShaft(std::int32_t increments_per_rev, std::uint8_t imax)
        : full_acceleration_(kFullAcceleration * increments_per_rev),
          fastest_(std::int64_t{kFastest} * increments_per_rev * kFraction / 60 / kDragSteps),
          imax_(imax) {}

    /// Increments since it was built.
    std::int64_t turned() const { return turned_; }
    bool at_end(int direction) const;
    bool can_turn(int direction, std::int32_t torque) const;
    /// Turned by the motor, one increment.
    void turn(int direction) { turned_ += direction; }
    /// Turned by hand or by a load, within the mechanical ends. Returns the increments.
    std::int32_t turn_by(std::int32_t increments);

    /// An end that the shaft is beyond holds it in place.
    void stop(bool above, std::int64_t at);
    void free() { low_ = high_ = std::nullopt; }
    /// The mechanical ends leave no room to move.
    bool is_blocked() const { return low_ && high_ && *low_ >= *high_; }
    void hold(bool held) { held_ = held; }
    void set_load(std::int32_t torque) { load_ = torque; }

    /// drag() has something to do.
    bool slips() const { return load_ != 0 || speed_ != 0; }
    /// Coasts from now on, signed, increments a second.
    void let_go(std::int64_t increments_per_second);
    /// 1 / kDragSteps of a second. `torque`: the motor's holding torque; empty: no power. Returns the
    /// increments by which the shaft should turn.
    std::int32_t drag(std::optional<std::int32_t> torque);
    /// The motor blocks the shaft.
    void stand() { speed_ = rest_ = 0; }

  private:
    /// Revolutions a second^2 of the whole holding torque on the rotor alone: 6 Nm / 2.7e-4 kg m^2 / 2 pi,
    /// and 9 Nm / 4.05e-4 kg m^2 of a MAC34-2 are the same (003 §III). R: of a MAC23 too.
    static constexpr std::int64_t kFullAcceleration = 3'537;

    static constexpr std::int64_t kFraction = 1 << 20;

    void slow_down();

    std::int64_t full_acceleration_;  // increments a second^2
    std::int64_t fastest_;            // as speed_
    std::int32_t imax_;
    std::int64_t turned_ = 0;
    std::optional<std::int64_t> low_, high_;
    bool held_ = false;
    std::int32_t load_ = 0;
    std::int64_t speed_ = 0;  // speed of a slipping shaft, increments a step, x 2^20
    std::int64_t rest_ = 0;   // fraction of an increment, x 2^20
};

}  // namespace nplc::sim
