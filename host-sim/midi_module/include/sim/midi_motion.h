#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "base/ring.h"
#include "sim/midi_inputs.h"
#include "sim/midi_memory.h"
#include "sim/midi_profile.h"
#include "sim/midi_shaft.h"
#include "sim/midi_supply.h"

namespace nplc::sim {

/// The motion of a MIDI module: set-point, position loop and shaft, in ticks of 0.125 us. MidiModule decides
/// which commands are allowed.
class MidiMotion {
  public:
    using Ticks = MidiProfile::Ticks;
    struct Segment {
        std::uint8_t number;
        std::uint32_t data;
    };

    struct Events {
        std::function<void()> on_braking;    ///< braking begun or cut; may cut the power
        std::function<void()> on_hard_stop;  ///< by stop_hard() or an end-stop
    };

    MidiMotion(registers::midi::Model model, std::uint8_t imax, const MidiInputs& inputs, MidiEeprom& eeprom,
               MidiSupply& supply, Events events)
        : model_(model),
          inputs_(inputs),
          eeprom_(eeprom),
          supply_(supply),
          events_(std::move(events)),
          shaft_(registers::midi::facts_of(model).increments_per_rev, imax) {}

    Ticks now() const { return ticks_; }
    /// Makes the next increment due by then; false: there is none, and the time is `until`.
    bool advance(Ticks until);

    void go_to(std::int32_t target);
    /// False: refused, another motion is in progress. Period 0 ends it.
    bool run(int direction, std::uint16_t period);
    bool add_segment(const Segment& segment);
    void ramp_down();
    /// Without a ramp; drops the segments.
    void stop_hard();
    void give_power() { powered_ = true; }
    void cut_power();
    /// Without supply a turning shaft coasts.
    void run_out();
    void set_origin();
    void set_position(std::int32_t position) { position_ = set_point_ = goal_ = position; }
    void forget_end_stops() { stopped_by_ = 0; }

    MidiShaft& shaft() { return shaft_; }
    const MidiShaft& shaft() const { return shaft_; }
    void set_load(std::int32_t torque);
    void turn_shaft(std::int32_t increments);

    std::int32_t position() const { return position_; }
    bool moving() const;
    bool follows_profile() const { return profile_.running(); }
    bool follows_segments() const { return mode_ == Mode::segments && profile_.running(); }
    bool powered() const { return powered_; }
    int direction() const { return direction_; }
    std::uint8_t torque() const;
    bool busy() const;
    bool braking_is_cut() const { return supply_.braking_is_cut(ticks_); }
    std::uint32_t stopped_by() const { return stopped_by_; }  ///< bits of the status
    std::size_t waiting_segments() const { return segments_.size(); }

  private:
    enum class Mode : std::uint8_t { idle, position, run, segments, coast };

    void begin(Mode mode, int direction);
    void next_segment();
    void end();
    void remember() { eeprom_.write_position(position_); }
    void schedule(Ticks after) { next_step_ = ticks_ + after; }
    void schedule_adjusting();
    void step();
    void step_profile();
    void step_adjusting();
    bool brake();
    void turn(int direction);
    void drag();
    bool adjusts() const;
    bool can_turn(int direction) const;
    bool blocked(int direction);

    registers::midi::Model model_;
    const MidiInputs& inputs_;
    MidiEeprom& eeprom_;
    MidiSupply& supply_;
    Events events_;
    MidiShaft shaft_;
    Ticks ticks_ = 0;
    std::optional<Ticks> next_step_;
    std::optional<Ticks> next_drag_;  ///< while there is a load, or the shaft coasts

    Mode mode_ = Mode::idle;
    MidiProfile profile_;
    int direction_ = 1;
    bool powered_ = false;
    bool pause_ = false;  ///< the running segment has no motion
    bool stalled_ = false;
    std::int32_t position_ = 0;
    std::int32_t set_point_ = 0;
    std::int32_t goal_ = 0;
    Ticks coast_interval_ = 0;
    std::uint32_t stopped_by_ = 0;
    base::Ring<Segment, 3> segments_;
};

}  // namespace nplc::sim
