#pragma once

#include <limits>

#include "cli/session.h"
#include "macreg/midi/module.h"
#include "midi_client/can_link.h"
#include "midi_client/player.h"
#include "midi_client/v24_link.h"

/// `macreg midi ...`: MIDI Ingenierie modules.
namespace nplc::macreg::cli {

/// The options given between `midi` and its command, or before `midi`.
struct MidiCommon {
    explicit MidiCommon(Common& all) : common(all) {}
    Common& common;
    operator Common&() const { return common; }
    static constexpr int kNotSaid = std::numeric_limits<int>::min();
    int address = kNotSaid;  ///< by default the factory's address
    std::uint32_t baud = 0;
    std::string model;
};

/// Throws UserError if --model names no model; nullopt if it was not given.
std::optional<midi::reg::Model> midi_model(const MidiCommon& midi);
bool is_can(const MidiCommon& midi);
std::uint32_t midi_baud(const MidiCommon& midi);
/// Throws UserError unless a module on this kind of line can have it; `what` is what was typed before it.
void look_at_address(const MidiCommon& midi, const char* what, int address);

/// An open line or bus, and the module of --address.
class MidiSession {
  public:
    explicit MidiSession(const MidiCommon& options, std::uint32_t baud = 0,
                         base::Microseconds patience = base::Microseconds{0});

    const Common& common() const { return common_; }
    midi_client::Master& master() { return *master_; }
    midi_client::Link& link() { return *link_; }
    /// Nothing on a serial line.
    midi_client::CanLink* can() { return can_link_; }
    midi::Module& module() { return *module_; }
    std::uint8_t address() const { return module_->address(); }
    void tell(const std::string& text, const Json& document) const {
        command_line::tell(common_, text, document);
    }

  private:
    void open_can(const MidiCommon& options, base::Microseconds patience);

    const Common& common_;
    std::unique_ptr<host::ByteClient> wire_;
    std::unique_ptr<host::CanClient> can_;
    std::unique_ptr<midi_client::Link> link_;
    midi_client::CanLink* can_link_ = nullptr;
    std::unique_ptr<midi_client::Master> master_;
    std::unique_ptr<midi::Module> module_;
};

/// Reads the typed value; throws UserError with `what` before the error.
std::int64_t number_of(const midi::TypedNumber& number, const char* what = "");

/// {"name":, "raw":, "value":}
Json midi_document(const midi::Parameter& parameter, std::int64_t raw, const midi::Scale& scale);

/// From now on signals are recorded (a second one and a hang-up too): a moving motor is stopped first.
void hold_signals();
/// Sends 17h, and 18h where that is refused or takes too long, until the motor stands still; returns the
/// position. Throws LineError with a warning in capitals if no stop is confirmed.
std::int32_t bring_to_rest(MidiSession& session);

/// Within a handler: ends the motion and throws the error again, with the warning if no stop is confirmed.
[[noreturn]] void stop_and_rethrow(MidiSession& session, const std::runtime_error& error);

using MidiSubcommand = command_line::Subcommand<MidiCommon>;
MidiSubcommand add_midi_find, add_midi_motion, add_midi_path, add_midi_raw, add_midi_service, add_midi_status,
    add_midi_values;

}  // namespace nplc::macreg::cli
