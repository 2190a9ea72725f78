#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "registers/midi.h"
#include "sim/midi_inputs.h"
#include "sim/midi_memory.h"
#include "sim/midi_motion.h"
#include "sim/midi_supply.h"
#include "sim/text.h"

namespace nplc::sim {

struct MidiOptions {
    bool can = false;                ///< a module for CAN instead of V24
    std::uint8_t address = 0;        ///< V24 0..7Fh, CAN 1..7Fh
    std::uint8_t imax = 0x80;        ///< RAM AFh
    std::uint32_t release = 0x0704;  ///< answer to GET_RELEASE; R: byte 3 is the release, byte 4 its index
};

/// A command that was carried out.
struct MidiAction {
    Time at;
    std::uint8_t number;
    std::uint32_t data;
};

/// A MIDI MAC23, MAC34-1 or MAC34-2 as seen through its commands, in virtual time. Independent of a line:
/// MidiV24End and MidiCanEnd connect it. The same calls give the same motion. README.md lists the manuals'
/// sections and the interpretations (R).
class MidiModule {
  public:
    using Model = registers::midi::Model;
    using Input = MidiInput;
    struct Leds {
        bool supply_good, fault, catching_up, top_zero, ballast;
        bool operator==(const Leds&) const = default;
    };

    /// Switched on, with the start-up time over.
    explicit MidiModule(Model model, const MidiOptions& options = {});
    MidiModule(const MidiModule&) = delete;
    MidiModule& operator=(const MidiModule&) = delete;

    /// Simulates up to that time.
    void advance(Time to);

    /// Executes a command; false: refused. RESET, FACTORY and BAUD take effect with restart().
    bool execute(std::uint8_t number, std::uint8_t sub_index, std::uint32_t data);
    std::optional<std::uint32_t> answer(std::uint8_t query, std::uint8_t sub_index) const;
    /// The last 10,000 commands carried out, oldest first.
    const std::deque<MidiAction>& actions() const { return actions_; }
    /// SYNC on the bus, and the command. False: what was prepared is not allowed now.
    bool sync();
    /// A restart was commanded; the line's end calls restart() once the answer has been sent.
    bool wants_restart() const { return wants_restart_; }
    void restart();
    /// LMT.
    void set_address(std::uint8_t address);

    /// No message is received: off, security input, or the two seconds after a restart.
    bool deaf() const { return !is_on() || input(Input::security) || motion_.now() < deaf_until_; }
    /// A start has been completed: true once per start.
    bool take_boot();

    // Environment.
    void power_off();
    void power_on();
    /// Sets a constant level; removes a switch.
    void set_input(Input input, bool active);
    bool input(Input input) const { return inputs_[input]; }
    void set_supply(std::int32_t millivolts);
    /// Voltage rise by braking on a supply that cannot absorb energy.
    void set_regeneration(std::int32_t millivolts) { supply_.set_regeneration(millivolts); }
    void set_temperature(std::int32_t thousandths);
    void connect_encoder(bool connected);
    void overload_amplifier() { trip(registers::midi::kAmplifierTrip); }
    void hold_shaft(bool held) { motion_.shaft().hold(held); }
    /// A mechanical end, in increments of shaft(); one that the shaft is beyond holds it in place.
    void stop_shaft(bool above, std::int64_t at) { motion_.shaft().stop(above, at); }
    void free_shaft() { motion_.shaft().free(); }
    bool shaft_is_blocked() const { return motion_.shaft().is_blocked(); }
    /// A switch at an input: active on one side of a position, in increments of shaft().
    void connect(Input input, bool on_above, std::int64_t at);
    /// A constant load torque in steps of TORQUE, positive clockwise. Below the motor's torque it is only
    /// compensated; above it, it drags the shaft.
    void set_load(std::int32_t torque) { motion_.set_load(torque); }
    /// Turned by hand; with power off it does not return.
    void turn_shaft(std::int32_t increments) { motion_.turn_shaft(increments); }

    Model model() const { return model_; }
    bool is_can() const { return options_.can; }
    std::uint8_t imax() const { return options_.imax; }  ///< reference of the torque values
    bool is_on() const { return supply_.is_on(); }
    /// 07h: the reference input sets the position to 0.
    bool reference_enabled() const { return reference_enabled_; }
    std::int32_t position() const { return motion_.position(); }
    /// Increments that the shaft has actually turned, independent of the position's origin.
    std::int64_t shaft() const { return motion_.shaft().turned(); }
    bool moving() const { return motion_.moving(); }
    bool powered() const { return motion_.powered(); }
    std::uint8_t torque() const { return motion_.torque(); }  ///< present motor torque, relative to Imax
    bool busy() const { return motion_.busy(); }              ///< the output: 003 §IV
    bool fault() const;                                       ///< the output
    std::uint32_t status() const;
    std::int32_t supply() const { return supply_.voltage(); }
    Leds leds() const;
    std::uint8_t waiting_segments() const { return static_cast<std::uint8_t>(motion_.waiting_segments()); }

    /// Baud rate of the serial line; a change takes effect at the restart.
    std::uint32_t baud() const { return registers::midi::baud_of(baud_code_); }
    const MidiMemory& memory() const { return eeprom_.values; }
    std::uint32_t memory_writes() const { return eeprom_.writes; }
    /// The memory's content at power-on.
    void set_memory(const MidiMemory& memory);

  private:
    using Ticks = MidiProfile::Ticks;

    // midi_module.cpp
    void start(Ticks deaf);
    void trip(std::uint32_t bit);
    void check_supply();
    void check_world();
    void look_at_switches();
    void change_input(Input input, bool active);
    std::uint32_t measures() const;
    std::uint32_t settings() const;

    // midi_commands.cpp
    bool carry_out(std::uint8_t number, std::uint8_t sub_index, std::uint32_t data);
    bool may_execute(const registers::midi::CommandRow& row, std::uint32_t data) const;
    bool set_parameter(std::uint8_t number, std::uint32_t data);
    bool move(std::uint8_t number, std::uint32_t data);
    bool prepare(std::uint8_t number, std::uint32_t data);
    void drop_prepared();
    bool run(std::uint32_t data);

    Model model_;
    MidiOptions options_;
    std::deque<MidiAction> actions_;
    MidiEeprom eeprom_;
    std::uint8_t baud_code_ = 3;
    Ticks deaf_until_ = 0;
    bool boot_pending_ = true;
    bool wants_restart_ = false;
    bool factory_reset_ = false;

    MidiInputs inputs_;
    MidiSupply supply_;
    bool reference_enabled_ = false;
    std::int32_t temperature_ = 25'000;
    bool encoder_ = true;
    std::uint32_t trips_ = 0;

    MidiMotion motion_;
    bool armed_ = false;
    std::optional<MidiMotion::Segment> prepared_;
};

}  // namespace nplc::sim
