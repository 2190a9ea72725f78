#pragma once

#include <cstdint>

namespace nplc::sim {

/// The speed regulator of 001 §4.2.1 in one step a sample: velocity error, its sum (the lag) and the sum of
/// that, and the change of FNC_OUT fed forward, together times KVOUT. R: the manual gives no coefficients;
/// these are ours.
///
/// If the torque limit is met, the step also answers by how much FNC_OUT should have been another for the
/// limit to be kept ("correction", 001 §4.2.1). The regulator goes on from the corrected velocity, so it
/// never winds up.
class Regulator {
  public:
    struct Input {
        std::int32_t fnc_out;       ///< wanted velocity, 1/16 counts/sample
        std::int32_t v_ist;         ///< measured velocity, counts/sample
        std::int32_t torque_limit;  ///< 0..1023
        std::int32_t kvout_256;     ///< KVOUT x 256
    };
    struct Output {
        std::int32_t torque = 0;      ///< VF_OUT, within the limit
        std::int32_t correction = 0;  ///< to be added to FNC_OUT, 1/16 counts/sample; 0 within the limit
    };

    /// `full_acceleration_16`: of the motor alone at full torque, 1/16 counts/sample^2.
    explicit Regulator(std::int32_t full_acceleration_16) : full_acceleration_16_(full_acceleration_16) {}

    Output step(const Input& input);
    void reset();
    /// Profile and shaft are at the same place and run at `velocity`, 1/16 counts/sample, in the next step.
    void restart(std::int32_t velocity);

    /// How far the shaft is behind the profile, corrections taken off, 1/16 counts.
    std::int64_t lag_16() const { return lag_16_; }

  private:
    std::int64_t full_acceleration_16_;
    std::int64_t lag_16_ = 0;
    std::int64_t integral_ = 0;
    std::int64_t last_fnc_out_ = 0;
};

}  // namespace nplc::sim
