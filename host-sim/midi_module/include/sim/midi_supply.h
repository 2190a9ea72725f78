#pragma once

#include <cstdint>

#include "registers/midi.h"

namespace nplc::sim {

/// The supply of a MIDI module with the effect of braking, in millivolts.
class MidiSupply {
  public:
    using Ticks = std::int64_t;

    explicit MidiSupply(const registers::midi::Facts& facts)
        : facts_(facts), set_(facts.max_supply * 3 / 5) {}

    void set(std::int32_t millivolts) { set_ = millivolts; }
    /// Voltage rise by braking on a supply that cannot absorb energy.
    void set_regeneration(std::int32_t millivolts) { regeneration_ = millivolts; }
    void switch_on(bool on) { on_ = on; }
    bool is_on() const { return on_; }
    std::int32_t voltage() const { return set_ + (brakes_ ? regeneration_ : 0); }
    bool warns_high() const { return voltage() >= facts_.over_voltage; }
    bool warns_low() const { return voltage() <= facts_.under_voltage; }
    bool trips_amplifier() const;
    bool trips_supply() const { return voltage() < registers::midi::kLeastSupply; }
    /// Latches an overvoltage warning until it is reset.
    void check() { over_voltage_kept_ = over_voltage_kept_ || warns_high(); }
    bool over_voltage_kept() const { return over_voltage_kept_; }
    void forget_over_voltage() { over_voltage_kept_ = false; }

    void brake(bool brakes) { brakes_ = brakes; }
    bool brakes() const { return brakes_; }
    bool braking_is_cut(Ticks now) const { return is_over_release(set_) || now < release_until_; }
    /// R: alternately 5 ms without and 5 ms with braking, as long as braking raises the voltage too high.
    void cut_excess(Ticks now);

  private:
    bool is_over_release(std::int32_t millivolts) const;

    const registers::midi::Facts& facts_;
    std::int32_t set_;
    std::int32_t regeneration_ = 0;
    bool on_ = true;
    bool brakes_ = false;
    bool over_voltage_kept_ = false;
    Ticks release_until_ = 0;
};

}  // namespace nplc::sim
