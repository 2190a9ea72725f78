#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

#include "arguments/arguments.h"

namespace nplc::sim {

/// Options is the program's own type, with a member `speed`.
template <class Options>
struct DeviceCommandLine {
    std::optional<Options> options;  ///< empty after --help or --version
    std::string error;               ///< one line; empty on success
};

/// For invalid values the functions below throw std::invalid_argument, with the option and the remedy.
std::int64_t whole_value(const std::string& option, const std::string& text, std::int64_t min,
                         std::int64_t max);
/// The parts before and behind the colon of MODEL:ADDRESS; `example` is one, for the message.
struct UnitText {
    std::string model;
    std::string address;
};
UnitText unit_value(const std::string& text, const std::string& example);

/// --speed, times real time.
void add_speed(arguments::App& app, const std::string& description, double& speed);
/// A further --unit.
void add_unit(arguments::App& app, const std::string& description,
              const std::function<void(const std::string&)>& take);

/// `device`: name of a unit in messages.
template <class Units>
void check_addresses(const Units& units, const std::string& device) {
    std::set<int> addresses;
    for (const auto& unit : units) {
        if (!addresses.insert(unit.address).second)
            throw std::invalid_argument("address " + std::to_string(unit.address) + " is given twice: each " +
                                        device + " on a line needs its own");
    }
}

/// Takes the command line, then calls `check`, which throws as above.
template <class Options>
DeviceCommandLine<Options> parse_devices(arguments::App& app, int argc, const char* const* argv,
                                         const Options& options, const std::function<void()>& check) {
    try {
        const arguments::ParseResult outcome = app.parse(argc, argv);
        if (outcome.kind == arguments::ParseResult::Kind::told) return {};
        if (outcome.kind == arguments::ParseResult::Kind::wrong)
            return {std::nullopt, outcome.error + " (see " + app.get_name() + " --help)"};
        check();
    } catch (const std::invalid_argument& error) {
        return {std::nullopt, error.what()};
    }
    return {options, {}};
}

}  // namespace nplc::sim
