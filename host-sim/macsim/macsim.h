#pragma once

#include <memory>
#include <string>

#include "rack.h"
#include "sim/device_server.h"

namespace nplc::sim {

struct MacsimOptions {
    RackOptions rack;
    std::string fastmac;  ///< endpoint, or empty
    std::string mactalk;
    std::string scenario;  ///< file: scenario of the first unit
    std::string plant;     ///< file: of the first unit
    std::string control;   ///< endpoint or "-", or empty: the control port
    std::string flash;     ///< file of the first unit; the others' have their address appended
    double speed = 1;
};

DeviceCommandLine<MacsimOptions> parse_macsim(int argc, const char* const* argv);
/// The rack with its clients and flash files; `error`: one line if something could not be opened.
std::unique_ptr<VirtualDevices> open_rack(const MacsimOptions& options, std::string& error);

}  // namespace nplc::sim
