#pragma once

#include <optional>
#include <string>
#include <vector>

#include "midi_rack.h"

namespace nplc::sim {

struct MidisimOptions {
    std::vector<MidiUnit> units = {{}};
    std::string v24;         ///< endpoint, or empty: then `can` is not
    std::string can;         ///< interface
    std::uint32_t baud = 0;  ///< of the client; 0: the first module's
    std::string eeprom;      ///< file of the first module; the others' with their address behind it
    double speed = 1;
};

struct MidisimCommandLine {
    std::optional<MidisimOptions> options;  ///< nothing after --help or --version
    std::string error;                      ///< one line; empty when it was understood
};

MidisimCommandLine parse_midisim(int argc, const char* const* argv);

}  // namespace nplc::sim
