#pragma once

#include <optional>
#include <string>

#include "rack.h"

namespace nplc::sim {

struct MacsimOptions {
    RackOptions rack;
    std::string fastmac;  ///< endpoint, or empty
    std::string mactalk;
    std::string flash;  ///< file of the first unit; the others' with their address behind it
    double speed = 1;
};

struct MacsimCommandLine {
    std::optional<MacsimOptions> options;  ///< nothing after --help or --version
    std::string error;                     ///< one line; empty when it was understood
};

MacsimCommandLine parse_macsim(int argc, const char* const* argv);

}  // namespace nplc::sim
