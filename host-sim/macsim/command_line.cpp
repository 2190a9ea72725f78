#include <fmt/format.h>

#include "macsim.h"

namespace nplc::sim {
namespace {

constexpr const char* kFooter =
    "EP is pty:PATH (PATH becomes a link to the terminal), unix:PATH or tcp:127.0.0.1:PORT. Prints `ready` "
    "when all are open.\nA client that is not there or does not read loses bytes, as on a serial line. "
    "SIGINT and SIGTERM end it cleanly.\nExit code: 0 ended by a signal, 2 a mistake in the command line, or "
    "something cannot be opened or written.";

registers::Model model(const std::string& option, const std::string& text) {
    if (const auto found = registers::model_of(text)) return *found;
    throw std::invalid_argument(
        fmt::format("{} \"{}\": write MAC50, MAC95, MAC140, MAC141 or MAC800", option, text));
}

std::uint8_t address(const std::string& option, const std::string& text) {
    return static_cast<std::uint8_t>(whole_value(option, text, 1, 254));
}

std::uint32_t baud(const std::string& option, const std::string& text) {
    return static_cast<std::uint32_t>(whole_value(option, text, 300, 1'000'000));
}

}  // namespace

DeviceCommandLine<MacsimOptions> parse_macsim(int argc, const char* const* argv) {
    arguments::App app("Virtual MAC motors in real time, for any program that talks to real ones", "macsim");
    MacsimOptions options;
    RackOptions& rack = options.rack;
    app.set_version_flag("--version", std::string("macsim ") + NPLC_VERSION);
    app.footer(kFooter);
    app.add_option("--model", "MAC50, MAC95, MAC140, MAC141 or MAC800 (MAC140)")
        ->each([&](const std::string& text) { rack.units[0].model = model("--model", text); });
    app.add_option("--address", "of the motor on the MacTalk line, 1..254 (1)")
        ->each([&](const std::string& text) { rack.units[0].address = address("--address", text); });
    app.add_option("--fastmac", options.fastmac, "where FastMAC/FlexMAC is spoken")->type_name("EP");
    app.add_option("--mactalk", options.mactalk, "where MacTalk is spoken")->type_name("EP");
    add_unit(app, "a further motor on the same MacTalk line; may be repeated", [&](const std::string& text) {
        const UnitText parts = unit_value(text, "MAC95:2");
        rack.units.push_back({model("--unit", parts.model), address("--unit", parts.address)});
    });
    app.add_option("--flash", options.flash,
                   "keep the parameter flash in this file (a further unit's: FILE.ADDRESS)")
        ->type_name("FILE");
    app.add_option("--scenario", options.scenario,
                   "what happens to the first motor: pulses, voltages, loads, stops, its supply; see "
                   "host-sim/scenario")
        ->type_name("S.scn");
    app.add_option(
           "--plant", options.plant,
           "inertia, friction and load of a real axis, as `macreg fit` writes them; of the first motor")
        ->type_name("axis.toml");
    app.add_option(
           "--control", options.control,
           "where lines such as `motor load 500` say what happens to the first motor, each answered; - is "
           "standard input")
        ->type_name("EP");
    add_speed(app, "times real time, lines included, 0.01..100 (1)", options.speed);
    app.add_option("--baud", "rate of the FastMAC line (19200)")->each([&](const std::string& text) {
        rack.fastmac_baud = baud("--baud", text);
    });
    app.add_option("--mactalk-baud", "rate of the MacTalk line (19200)")->each([&](const std::string& text) {
        rack.mactalk_baud = baud("--mactalk-baud", text);
    });
    app.add_flag("--old-codes", rack.old_register_codes, "the older FastMAC register codes");
    return parse_devices(app, argc, argv, options, [&] {
        if (options.fastmac.empty() && options.mactalk.empty())
            throw std::invalid_argument(
                "name --fastmac EP, --mactalk EP or both: nobody could talk to the motor");
        check_addresses(rack.units, "unit");
    });
}

}  // namespace nplc::sim
