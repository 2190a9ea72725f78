#include <fmt/format.h>

#include "midisim.h"
#include "sim/text.h"

namespace nplc::sim {
namespace {

constexpr int kMaxAddress = 127;
constexpr const char* kFooter =
    "EP is pty:PATH (PATH becomes a link to the terminal), unix:PATH or tcp:127.0.0.1:PORT. Prints `ready` "
    "when all are open.\nA client that is not there or does not read loses bytes, as on a serial line. "
    "SIGINT and SIGTERM end it cleanly; the modules keep their positions.\nExit code: 0 ended by a signal, 2 "
    "a mistake in the command line, or something cannot be opened or written.";

registers::midi::Model model(const std::string& option, const std::string& text) {
    if (const auto found = registers::midi::model_of(text)) return *found;
    throw std::invalid_argument(fmt::format("{} \"{}\": write MAC23, MAC34-1 or MAC34-2", option, text));
}

/// 003 §V.1: on CAN address 0 is the broadcast address.
std::uint8_t address(const std::string& option, const std::string& text, bool on_can) {
    return static_cast<std::uint8_t>(whole_value(option, text, on_can ? 1 : 0, kMaxAddress));
}

/// MODEL:ADDRESS
MidiUnit unit(const std::string& text, bool on_can) {
    const UnitText parts = unit_value(text, "MAC23:2");
    return {model("--unit", parts.model), address("--unit", parts.address, on_can)};
}

std::uint32_t baud(const std::string& text) {
    const auto value = parse_integer(text);
    for (int code = 1; code <= 3; ++code) {
        if (value == registers::midi::baud_of(code)) return registers::midi::baud_of(code);
    }
    throw std::invalid_argument(fmt::format("--baud \"{}\": write 9600, 19200 or 38400", text));
}

void check(const MidisimOptions& options) {
    if (options.v24.empty() && options.can.empty())
        throw std::invalid_argument("name --v24 EP or --can INTERFACE: nobody could talk to the module");
    if (!options.v24.empty() && !options.can.empty())
        throw std::invalid_argument("a module has one line: name --v24 or --can, not both");
    if (!options.can.empty() && options.baud != 0)
        throw std::invalid_argument(
            "--baud belongs to --v24; a CAN interface has its bit rate from the system");
    for (const MidiUnit& one : options.units) {
        const auto& facts = registers::midi::facts_of(one.model);
        if (!options.can.empty() && !facts.has_can)
            throw std::invalid_argument(
                fmt::format("there is no {} with CAN: write MAC34-1 or MAC34-2", facts.name));
    }
    check_addresses(options.units, "module");
}

}  // namespace

DeviceCommandLine<MidisimOptions> parse_midisim(int argc, const char* const* argv) {
    arguments::App app("Virtual MIDI modules in real time, for any program that talks to real ones",
                       "midisim");
    MidisimOptions options;
    MidiUnit& first = options.units.front();
    std::string first_address;
    std::vector<std::string> further;
    app.set_version_flag("--version", std::string("midisim ") + NPLC_VERSION);
    app.footer(kFooter);
    app.add_option("--model", "MAC23, MAC34-1 or MAC34-2 (MAC34-1)")->each([&](const std::string& text) {
        first.model = model("--model", text);
    });
    app.add_option("--address",
                   "of the module while its EEPROM file has none, 0..127 (0), with --can 1..127 (1)")
        ->each([&](const std::string& text) { first_address = text; });
    app.add_option("--v24", options.v24, "where the serial line is")->type_name("EP");
    app.add_option("--can", options.can, "the CAN interface it is on, set up and up")->type_name("INTERFACE");
    add_unit(app, "a further module on the same line; may be repeated",
             [&](const std::string& text) { further.push_back(text); });
    app.add_option("--eeprom", options.eeprom,
                   "keep parameters and position in this file (a further module's: FILE.ADDRESS)")
        ->type_name("FILE");
    app.add_option("--baud",
                   "rate of the client: 9600, 19200, 38400 (the first module's, also when it changes)")
        ->each([&](const std::string& text) { options.baud = baud(text); });
    app.add_option(
           "--control", options.control,
           "where lines such as `motor load 500` say what happens to the first module, each answered; - is "
           "standard input")
        ->type_name("EP");
    add_speed(app, "times real time, line included, 0.01..100 (1)", options.speed);
    return parse_devices(app, argc, argv, options, [&] {
        const bool on_can = !options.can.empty();
        first.address = on_can ? 1 : 0;  // from the factory
        if (!first_address.empty()) first.address = address("--address", first_address, on_can);
        for (const std::string& text : further) options.units.push_back(unit(text, on_can));
        check(options);
    });
}

}  // namespace nplc::sim
