#pragma once

#include <memory>
#include <string>
#include <vector>

#include "midi_rack.h"
#include "sim/device_server.h"

namespace nplc::sim {

struct MidisimOptions {
    std::vector<MidiUnit> units = {{}};
    std::string v24;         ///< endpoint; empty: `can` is used
    std::string can;         ///< interface
    std::uint32_t baud = 0;  ///< of the client; 0: the first module's
    std::string control;     ///< endpoint or "-", or empty: the control port for the first module
    std::string eeprom;      ///< file of the first module; the others' have their address appended
    double speed = 1;
};

DeviceCommandLine<MidisimOptions> parse_midisim(int argc, const char* const* argv);
/// Modules on a serial line with a client, or on a CAN interface of this machine, with their EEPROM files;
/// `error`: one line if something could not be opened.
std::unique_ptr<VirtualDevices> open_modules(const MidisimOptions& options, std::string& error);

}  // namespace nplc::sim
