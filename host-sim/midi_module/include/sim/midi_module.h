#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>

#include "base/ring.h"
#include "registers/midi.h"
#include "sim/midi_memory.h"
#include "sim/midi_profile.h"
#include "sim/midi_shaft.h"
#include "sim/text.h"

namespace nplc::sim {

struct MidiOptions {
    bool can = false;                ///< a module for CAN instead of V24
    std::uint8_t address = 0;        ///< V24 0..7Fh, CAN 1..7Fh
    std::uint8_t imax = 0x80;        ///< RAM AFh
    std::uint32_t release = 0x0704;  ///< as GET_RELEASE tells it; R: byte 3 is the release, byte 4 its index
};

/// A command that was carried out.
struct MidiDeed {
    Time at;
    std::uint8_t number;
    std::uint32_t data;
};

/// A MIDI MAC23, MAC34-1 or MAC34-2 as its commands show it, in virtual time. It knows no line: MidiV24End
/// and MidiCanEnd speak for it. The same calls give the same motion. README.md tells where the manuals'
/// sections are and what is our own reading (R).
class MidiModule {
  public:
    using Model = registers::midi::Model;
    enum class Input : std::uint8_t { upper_stop, lower_stop, reference, security };
    struct Leds {
        bool supply_good, fault, catching_up, top_zero, ballast;
        bool operator==(const Leds&) const = default;
    };

    /// Switched on, and started long ago.
    explicit MidiModule(Model model, const MidiOptions& options = {});

    /// Does all that happens until then.
    void advance(Time to);

    /// Carries out a command; false: refused. RESET, FACTORY and BAUD only begin with restart().
    bool execute(std::uint8_t number, std::uint8_t sub_index, std::uint32_t data);
    std::optional<std::uint32_t> answer(std::uint8_t query, std::uint8_t sub_index) const;
    /// The last 10,000 commands carried out, oldest first.
    const std::deque<MidiDeed>& deeds() const { return deeds_; }
    /// SYNC on the bus: like the command, without an answer.
    void sync() { start_prepared(); }
    /// A restart was ordered; the end calls restart() once its answer has left.
    bool wants_restart() const { return wants_restart_; }
    void restart();
    /// LMT.
    void set_address(std::uint8_t address);

    /// No message is heard: off, security input, or the two seconds after a restart.
    bool deaf() const { return !on_ || inputs_[index(Input::security)] || ticks_ < deaf_until_; }
    /// A start is complete: true once for each.
    bool take_boot();

    // The world around it.
    void power_off();
    void power_on();
    /// For good: takes a switch off.
    void set_input(Input input, bool active);
    bool input(Input input) const { return inputs_[index(input)]; }
    void set_supply(std::int32_t millivolts);
    /// What braking adds to a supply that takes nothing back.
    void set_regeneration(std::int32_t millivolts) { regeneration_ = millivolts; }
    void set_temperature(std::int32_t thousandths);
    void connect_encoder(bool connected);
    void overload_amplifier() { trip(registers::midi::kAmplifierTrip); }
    void hold_shaft(bool held) { shaft_.hold(held); }
    /// A mechanical end, in increments of shaft(); one that the shaft is beyond holds it where it is.
    void stop_shaft(bool above, std::int64_t at) { shaft_.stop(above, at); }
    void free_shaft() { shaft_.free(); }
    /// A switch at an input: active on one side of a place, in increments of shaft().
    void connect(Input input, bool on_above, std::int64_t at);
    /// A constant pull in steps of TORQUE, positive clockwise. Below the motor's torque it only has to be
    /// overcome; above it, it drags the shaft.
    void set_load(std::int32_t torque);
    void turn_shaft(std::int32_t increments);  ///< by hand; with power off nothing turns it back

    Model model() const { return model_; }
    bool is_can() const { return options_.can; }
    bool is_on() const { return on_; }
    std::int32_t position() const { return position_; }
    /// Increments that the shaft has really turned, whatever the position was set to.
    std::int64_t shaft() const { return shaft_.turned(); }
    bool moving() const;
    bool powered() const { return powered_; }
    std::uint8_t torque() const;  ///< what the motor has now, of Imax
    bool busy() const;            ///< the output: 003 §IV
    bool fault() const;           ///< the output
    std::uint32_t status() const;
    std::int32_t supply() const { return supply_ + (braking_ ? regeneration_ : 0); }
    Leds leds() const;
    std::uint8_t waiting_segments() const { return static_cast<std::uint8_t>(segments_.size()); }

    /// Of the serial line; a change holds from the restart on.
    std::uint32_t baud() const { return registers::midi::baud_of(baud_code_); }
    const MidiMemory& memory() const { return memory_; }
    std::uint32_t memory_writes() const { return memory_writes_; }
    /// As found at power-on.
    void set_memory(const MidiMemory& memory);

  private:
    using Ticks = MidiProfile::Ticks;
    enum class Mode : std::uint8_t { idle, position, run, segments, coast };
    struct Prepared {
        std::uint8_t number;
        std::uint32_t data;
    };
    static constexpr std::size_t index(Input input) { return static_cast<std::size_t>(input); }

    // midi_module.cpp
    void start(Ticks deaf);
    void trip(std::uint32_t bit);
    void check_supply();
    void check_world();
    void remember();
    std::uint32_t measures() const;
    std::uint32_t settings() const;

    // midi_commands.cpp
    bool carry_out(std::uint8_t number, std::uint8_t sub_index, std::uint32_t data);
    bool may_execute(const registers::midi::CommandRow& row, std::uint32_t data) const;
    bool set_parameter(std::uint8_t number, std::uint32_t data);
    bool move(std::uint8_t number, std::uint32_t data);
    bool prepare(std::uint8_t number, std::uint32_t data);
    bool start_prepared();
    bool run(std::uint32_t data);
    bool add_segment(std::uint8_t number, std::uint32_t data);

    // midi_motion.cpp
    void go_to(std::int32_t target);
    void begin_motion(Mode mode, int direction);
    void next_segment();
    void ramp_down();
    void stop_hard();
    void cut_power();
    void end_motion();
    void set_origin();
    void schedule(Ticks after);
    void step();
    void step_profile();
    bool brake();
    void step_adjusting();
    void turn(int direction);
    bool adjusts() const;
    bool can_turn(int direction) const;
    void look_at_switches();
    void change_input(Input which, bool active);
    void run_out();
    void drag();
    bool is_over_release(std::int32_t millivolts) const;
    bool braking_is_cut() const;
    bool blocked(int direction);

    Model model_;
    MidiOptions options_;
    std::deque<MidiDeed> deeds_;
    MidiMemory memory_;
    std::uint32_t memory_writes_ = 0;
    std::uint8_t baud_code_ = 3;
    Ticks ticks_ = 0;
    Ticks deaf_until_ = 0;
    bool on_ = true;
    bool boot_pending_ = true;
    bool wants_restart_ = false;
    bool factory_reset_ = false;

    struct Switch {
        std::int64_t at;
        bool on_above;
    };

    bool inputs_[4] = {};
    std::array<std::optional<Switch>, 4> switches_;
    MidiShaft shaft_;
    bool reference_enabled_ = false;
    std::int32_t supply_;
    std::int32_t regeneration_ = 0;
    std::int32_t temperature_ = 25'000;
    bool encoder_ = true;
    std::optional<Ticks> next_drag_;  ///< while there is a load, or the shaft runs out

    std::uint32_t trips_ = 0;
    std::uint32_t stopped_by_ = 0;
    bool over_voltage_kept_ = false;
    bool powered_ = false;

    Mode mode_ = Mode::idle;
    MidiProfile profile_;
    int direction_ = 1;
    bool pause_ = false;  ///< the running segment moves nothing
    std::int32_t position_ = 0;
    std::int32_t set_point_ = 0;
    std::int32_t goal_ = 0;
    bool stalled_ = false;
    bool braking_ = false;
    Ticks release_until_ = 0;
    Ticks coast_interval_ = 0;
    std::optional<Ticks> next_step_;
    bool armed_ = false;
    std::optional<Prepared> prepared_;
    base::Ring<Prepared, 3> segments_;
};

}  // namespace nplc::sim
