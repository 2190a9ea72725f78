#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>

#include "registers/mac.h"
#include "sim/motor_memory.h"
#include "sim/motor_state.h"

namespace nplc::sim {

/// Signal format of a generator at the pulse input (001 §3.2.36, PULSEDIR).
enum class PulseFormat : std::uint8_t {
    quadrature,           ///< four counts a period of its lines
    pulse_and_direction,  ///< one count a pulse
};

/// Configuration of the pulse input's pins at power-up (001 §3.2.36 bits 0 to 4; 004 HW_SETUP).
class PulseInput {
  public:
    /// R: MAC800 (004 gives names only): XPRINP is PULSEDIR, INVXDIR is INPSIGN, NOFILT is HICLK; the input
    /// is always there.
    void configure(registers::Model model, std::int32_t cntrl_bits, std::int32_t hw_setup);

    bool on() const { return on_; }
    /// So fast that nothing passes the filter.
    bool filters(PulseFormat generator, std::int64_t counts_per_second) const;
    /// Counts of V_EXT per count of the generator: this over four, with the sign. 0: none. R: above the
    /// filter's frequency nothing passes; quadrature on an input for pulses counts one edge of four, pulses
    /// on one for quadrature count back and forth.
    int quarters(PulseFormat generator, std::int64_t counts_per_second) const;

  private:
    bool on_ = false;
    bool inverted_ = false;
    bool fast_ = false;
    PulseFormat format_ = PulseFormat::quadrature;
};

/// A switch at the axis: 10 V on one side of a position, 0 V on the other.
struct PositionSensor {
    std::int64_t counts = 0;  ///< of the shaft, as Plant counts them
    bool on_above = true;     ///< else on below
};

/// Signals at the motor's analogue input and, if its pins are free, at its pulse input.
class Terminals {
  public:
    /// Sets a constant voltage; removes a sensor.
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

/// ANINP at 10 V.
constexpr std::int32_t analogue_full_scale(registers::Model model) {
    return is_mac800(model) ? 2048 : 1023;
}

/// ANINP for a voltage in millivolts, before ANINP_OFFSET: 10 V are 1023 (001 §3.2.122), on MAC800 2048
/// (004). Voltages beyond +/- 10 V read as 10 V.
constexpr std::int32_t analogue_register(registers::Model model, std::int32_t millivolts) {
    constexpr std::int32_t kFullScale = 10'000;  // mV
    return std::clamp(millivolts, -kFullScale, kFullScale) * analogue_full_scale(model) / kFullScale;
}

/// The same, cached for a voltage that rarely changes.
class AnalogueVoltage {
  public:
    std::int32_t of(registers::Model model, std::int32_t millivolts) {
        if (millivolts != millivolts_) {
            millivolts_ = millivolts;
            register_ = analogue_register(model, millivolts);
        }
        return register_;
    }

  private:
    std::int32_t millivolts_ = 0;
    std::int32_t register_ = 0;
};

/// The analogue input as a logic level: on above 5.4 V, off below 4.4 V (001 §4.1.10; R: in homing too).
class AnalogueLevel {
  public:
    explicit AnalogueLevel(registers::Model model)
        : above_(analogue_register(model, 5'400)), below_(analogue_register(model, 4'400)) {}

    /// `aninp`: with ANINP_OFFSET.
    bool update(std::int32_t aninp) {
        if (aninp > above_) on_ = true;
        if (aninp <= below_) on_ = false;
        return on_;
    }
    bool on() const { return on_; }

  private:
    std::int32_t above_;  // no register value lies between a limit and the whole number below it
    std::int32_t below_;
    bool on_ = false;
};

/// Ambient conditions of a MAC800 besides its terminals (004); changeable at any time.
struct Surroundings {
    static constexpr std::int32_t kRoom = 25;
    std::int32_t celsius = kRoom;
    std::int32_t logic_millivolts = 24'000;
    bool encoder_broken = false;

    /// Correction of the servo's DEGC, which assumes air at room temperature. 0.12207 degrees each.
    std::int32_t degc() const {
        return static_cast<std::int32_t>(std::int64_t{celsius - kRoom} * 100'000 / 12'207);
    }
    /// U_24V: 0.013428 V each.
    std::int32_t u_24v() const {
        return static_cast<std::int32_t>(std::int64_t{logic_millivolts} * 1000 / 13'428);
    }
};

/// Reads terminals and ambient conditions in each sample: ANINP and its logic level, V_EXT, DEGC and U_24V
/// (001 §3.2.120, §3.2.122; 004).
class MotorInputs {
  public:
    explicit MotorInputs(MotorState& state) : state_(state), level_(state.model()) {}

    void power_up();
    /// `counts`: of the shaft.
    void read(std::int64_t counts);

    const PulseInput& pulse_input() const { return pulse_input_; }
    /// The analogue input is on.
    bool level() const { return level_.on(); }
    /// It has changed since the previous sample.
    bool level_changed() const { return level_.on() != level_was_on_; }

    Terminals terminals;
    Surroundings surroundings;

  private:
    MotorState& state_;
    PulseInput pulse_input_;
    AnalogueVoltage voltage_;
    AnalogueLevel level_;
    bool level_was_on_ = false;
};

}  // namespace nplc::sim
