#pragma once

#include <cstdint>

namespace nplc::sim {

/// The search for the home position, a sample at a time (001 §4.4.13 - §4.4.15): which velocity it wants, and
/// when the zero is found. Knows no registers and moves nothing.
class Homing {
  public:
    enum class Method : std::uint8_t {
        torque,       ///< HOME1: against a mechanical limit
        sensor_on,    ///< HOME2: where the sensor becomes active
        sensor_left,  ///< HOME3: to the sensor, and slowly off it
    };
    struct Input {
        std::int32_t v_home;  ///< 1/16 counts/sample, its sign is the direction of the search
        std::int32_t t_home;
        std::int32_t torque;  ///< VF_OUT
        bool sensor;          ///< the analogue input's level
    };
    static constexpr int kDetections = 50;

    void begin(Method method);
    Method method() const { return method_; }

    /// True: this is the zero. Not to be called after that without begin().
    bool step(const Input& input);
    /// What the search wants now, 1/16 counts/sample.
    std::int32_t velocity() const { return velocity_; }

    /// HOME1's: 1.25 x T_HOME (001 §3.2.41).
    static std::int32_t torque_limit(std::int32_t t_home);
    /// HOME3's velocity off the sensor: -V_HOME / 64 + 1 (R: cut to an integer, 1 at the least and never
    /// towards the sensor).
    static std::int32_t creep(std::int32_t v_home);

  private:
    enum class Phase : std::uint8_t { leaving, approaching, creeping };

    bool step_torque(const Input& input);
    bool step_sensor(const Input& input);

    Method method_ = Method::torque;
    Phase phase_ = Phase::leaving;
    int detections_ = 0;
    std::int32_t velocity_ = 0;
};

}  // namespace nplc::sim
