#pragma once

#include <string>
#include <vector>

#include "command_line.h"
#include "midi_rack.h"
#include "sim/endpoint.h"
#include "sim/served.h"

namespace nplc::sim {

/// The rack with its client and its EEPROM files. Time is given.
class MidiService final : public Served {
  public:
    /// Opens everything; `error` says in one line what could not be.
    MidiService(const MidisimOptions& options, std::string& error);

    std::string advance(Time to) override;
    std::string endpoints() const override { return v24_.described("v24"); }
    std::string status() const override;
    /// Switches the modules off, so that they keep their positions.
    std::string finish() override;

  private:
    struct Eeprom {
        std::string path;
        std::uint32_t written = 0;
    };
    std::string open_files(const MidisimOptions& options);
    std::string keep_files();

    MidiRack rack_;
    Endpoint v24_;
    std::vector<Eeprom> files_;
};

/// "MAC34-1 @0 P 1200 moves VMOT-OK TOP-ZERO status 00000000": the five LEDs by their names.
std::string describe(const MidiModule& module);

}  // namespace nplc::sim
