#pragma once

#include <memory>
#include <string>
#include <vector>

#include "midi_rack.h"
#include "sim/device_server.h"

namespace nplc::sim {

struct MidisimOptions {
    std::vector<MidiUnit> units = {{}};
    std::string v24;         ///< endpoint, or empty: then `can` is not
    std::string can;         ///< interface
    std::uint32_t baud = 0;  ///< of the client; 0: the first module's
    std::string control;     ///< endpoint or "-", or empty: where it is said what happens to the first module
    std::string eeprom;      ///< file of the first module; the others' with their address behind it
    double speed = 1;
};

DeviceCommandLine<MidisimOptions> parse_midisim(int argc, const char* const* argv);
/// Modules on a serial line with a client, or on a CAN interface of this machine, with their EEPROM files;
/// `error` says in one line what could not be opened.
std::unique_ptr<VirtualDevices> open_modules(const MidisimOptions& options, std::string& error);

}  // namespace nplc::sim
