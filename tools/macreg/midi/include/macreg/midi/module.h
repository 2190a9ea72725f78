#pragma once

#include <map>

#include "macreg/midi/values.h"
#include "midi_client/master.h"

/// One MIDI module on a line or bus.
namespace nplc::macreg::midi {

/// All readable values of a module, at about one time.
struct Readings {
    std::map<std::uint8_t, std::uint32_t> replies{};  ///< by query

    std::uint32_t reply(reg::Query query) const { return replies.at(query); }
    /// Of a parameter that can be read.
    std::int64_t raw(const Parameter& parameter) const { return raw_in(parameter, reply(*parameter.query)); }
    std::int64_t raw(std::string_view name) const { return raw(*find_parameter(name)); }
    std::int32_t position() const { return static_cast<std::int32_t>(reply(reg::GET_POSITION)); }
    std::uint32_t status() const { return reply(reg::GET_STATUS); }
    std::uint32_t measures() const { return reply(reg::GET_MEASURES); }
    bool busy() const { return (measures() & reg::kNotBusy) == 0; }
};

struct ChangeResult {
    std::optional<std::int64_t> before{}, after{};  ///< nullopt where it cannot be read
    bool taken = false;
    std::string why{};  ///< a sentence if it was not accepted
};

class Module {
  public:
    Module(midi_client::Master& master, std::uint8_t address, std::optional<reg::Model> model)
        : master_(master), address_(address), scale_{.model = model} {}

    midi_client::Master& master() { return master_; }
    std::uint8_t address() const { return address_; }

    /// With Imax and full speed as they are set in the module now.
    const Scale& scale();
    /// What is known without a request.
    const Scale& known_scale() const { return scale_; }

    std::int64_t read(const Parameter& parameter);
    Readings read_all();

    /// Writes and reads back; an unconfirmed write is repeated. A parameter that cannot be read is written
    /// once.
    ChangeResult change(const Parameter& parameter, std::int64_t raw);

    /// Compares two reads of its position, or reads BUSY.
    bool moves();
    /// Why it refused this command, as far as its state shows: "it is refused while the axis moves; ...".
    std::string refusal(std::uint8_t command, std::uint32_t data);
    /// Throws midi_client::Refused with the reason.
    void order(reg::Command command, std::uint32_t data = 0);

  private:
    std::uint32_t ask_imax();

    midi_client::Master& master_;
    std::uint8_t address_;
    Scale scale_;
    bool scale_read_ = false;
};

}  // namespace nplc::macreg::midi
