#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "command_line/program.h"
#include "nanofleet/broker.h"

namespace nplc::nanofleet::cli {

using command_line::Json;
using command_line::UserError;

struct Common : command_line::Common {
    std::string fleet = "fleet.toml";
    std::function<std::uint64_t()> calendar;  ///< ms since 1970
    std::function<std::uint64_t()> steady;    ///< ms, monotonic
};

/// The content uploaded for a table's file: with its set-points and, if named, its certificate's digest.
std::vector<std::uint8_t> artifact_of(const std::string& file, const std::string& symbols,
                                      const std::string& proof);

/// `name`, or the file's own without its ending.
std::string name_of_table(const std::string& file, const std::string& name);

/// Waits until the broker has confirmed all, and then this long for retained messages. Throws Failure if it
/// does not confirm.
void listen(const Common& common, Broker& broker, std::uint32_t milliseconds);

void add_keys(arguments::App& app, Common& common);
void add_sign(arguments::App& app, Common& common);
void add_status(arguments::App& app, Common& common);
void add_roll_out(arguments::App& app, Common& common);

}  // namespace nplc::nanofleet::cli
