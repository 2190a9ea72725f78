#include "command_line.h"

#include <fmt/format.h>

#include <set>
#include <stdexcept>

#include "arguments/arguments.h"
#include "sim/option_values.h"

namespace nplc::sim {
namespace {

constexpr const char* kFooter =
    "EP is pty:PATH (PATH becomes a link to the terminal), unix:PATH or tcp:127.0.0.1:PORT. Prints `ready` "
    "when "
    "all are open.\nA client that is not there or does not read loses bytes, as on a serial line. SIGINT and "
    "SIGTERM end it cleanly.\nExit code: 0 ended by a signal, 2 a mistake in the command line, or something "
    "cannot "
    "be opened or written.";

registers::Model model(const std::string& option, const std::string& text) {
    if (const auto found = registers::model_of(text)) return *found;
    throw std::invalid_argument(
        fmt::format("{} \"{}\": write MAC50, MAC95, MAC140, MAC141 or MAC800", option, text));
}

/// MODEL:ADDRESS
UnitOptions unit(const std::string& text) {
    const UnitText parts = unit_value(text, "MAC95:2");
    return {model("--unit", parts.model),
            static_cast<std::uint8_t>(whole_value("--unit", parts.address, 1, 254))};
}

void check(const MacsimOptions& options) {
    if (options.fastmac.empty() && options.mactalk.empty())
        throw std::invalid_argument(
            "name --fastmac EP, --mactalk EP or both: nobody could talk to the motor");
    std::set<int> addresses;
    for (const UnitOptions& unit : options.rack.units) {
        if (!addresses.insert(unit.address).second)
            throw std::invalid_argument(
                fmt::format("address {} is given twice: each unit on a line needs its own", unit.address));
    }
}

}  // namespace

MacsimCommandLine parse_macsim(int argc, const char* const* argv) {
    arguments::App app("Virtual MAC motors in real time, for any program that talks to real ones", "macsim");
    MacsimOptions options;
    UnitOptions& first = options.rack.units.front();
    app.set_version_flag("--version", std::string("macsim ") + NPLC_VERSION);
    app.footer(kFooter);
    app.add_option("--model", "MAC50, MAC95, MAC140, MAC141 or MAC800 (MAC140)")
        ->each([&](const std::string& text) { first.model = model("--model", text); });
    app.add_option("--address", "of the motor on the MacTalk line, 1..254 (1)")
        ->each([&](const std::string& text) {
            first.address = static_cast<std::uint8_t>(whole_value("--address", text, 1, 254));
        });
    app.add_option("--fastmac", options.fastmac, "where FastMAC/FlexMAC is spoken")->type_name("EP");
    app.add_option("--mactalk", options.mactalk, "where MacTalk is spoken")->type_name("EP");
    app.add_option("--unit", "a further motor on the same MacTalk line; may be repeated")
        ->type_name("MODEL:ADDRESS")
        ->repeatable()
        ->each([&](const std::string& text) { options.rack.units.push_back(unit(text)); });
    app.add_option("--flash", options.flash,
                   "keep the parameter flash in this file (a further unit's: FILE.ADDRESS)")
        ->type_name("FILE");
    app.add_option("--speed", "times real time, lines included, 0.01..100 (1)")
        ->each([&](const std::string& text) { options.speed = speed_value(text); });
    app.add_option("--baud", "rate of the FastMAC line (19200)")->each([&](const std::string& text) {
        options.rack.fastmac_baud = static_cast<std::uint32_t>(whole_value("--baud", text, 300, 1'000'000));
    });
    app.add_option("--mactalk-baud", "rate of the MacTalk line (19200)")->each([&](const std::string& text) {
        options.rack.mactalk_baud =
            static_cast<std::uint32_t>(whole_value("--mactalk-baud", text, 300, 1'000'000));
    });
    app.add_flag("--old-codes", options.rack.old_register_codes, "the older FastMAC register codes");
    try {
        const arguments::Outcome outcome = app.parse(argc, argv);
        if (outcome.kind == arguments::Outcome::Kind::told) return {};
        if (outcome.kind == arguments::Outcome::Kind::wrong)
            return {std::nullopt, outcome.error + " (see macsim --help)"};
        check(options);
    } catch (const std::invalid_argument& error) {
        return {std::nullopt, error.what()};
    }
    return {options, {}};
}

}  // namespace nplc::sim
