#pragma once

#include <cstdint>
#include <optional>

namespace nplc::sim {

/// A mechanical end of travel.
struct MechanicalStop {
    std::int64_t counts = 0;  ///< where it begins, encoder counts from where the motor was built
    /// Torque that each count into it gives back, x 1024; 0: rigid, all motion ends there. A springy one
    /// swallows the motion too: it pushes back, it does not throw.
    std::int64_t spring_1024 = 0;
};

/// What the motor's shaft is coupled to. Torques as in T_SOLL: 1023 is the motor's full torque.
struct Load {
    std::int32_t inertia_256 = 256;  ///< motor and load over the motor's own inertia, x 256 (KVOUT's meaning)
    std::int32_t friction_torque = 5;           ///< Coulomb friction
    std::int32_t torque = 0;                    ///< constant pull, positive turns the shaft forward
    std::optional<MechanicalStop> low_stop{};   ///< below which the shaft is held
    std::optional<MechanicalStop> high_stop{};  ///< above which it is
};

/// Shaft, load and encoder, one motor sample at a time. Integer arithmetic, so every machine computes the
/// same.
class Plant {
  public:
    /// `full_acceleration_16`: what full torque gives the bare motor, 1/16 counts/sample^2.
    Plant(std::int32_t full_acceleration_16, const Load& load);

    /// One sample with the motor's `torque`.
    void drive(std::int32_t torque);
    /// One sample with the windings short-circuited, as in INIT mode: brakes in proportion to the velocity.
    void short_circuit();

    /// Encoder counts since the motor was built.
    std::int64_t counts() const;

    /// May be changed at any time. A rigid stop that the shaft is beyond puts it back there.
    Load& load() { return load_; }
    const Load& load() const { return load_; }

  private:
    void advance(std::int64_t torque);
    std::int64_t speed_change(std::int64_t torque) const;
    std::int64_t inertia() const;
    const MechanicalStop* stop_beyond() const;
    void press(const MechanicalStop& stop, std::int64_t from);

    std::int64_t full_acceleration_16_;
    Load load_;
    std::int64_t position_ = 0;  // 1/65536 counts
    std::int64_t velocity_ = 0;  // 1/65536 counts/sample
};

}  // namespace nplc::sim
