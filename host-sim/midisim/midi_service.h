#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "command_line.h"
#include "hal_linux/socket_can.h"
#include "midi_can_rack.h"
#include "midi_rack.h"
#include "sim/endpoint.h"
#include "sim/served.h"

namespace nplc::sim {

/// What modules keep without power, a file each.
class EepromFiles {
  public:
    using ModuleAt = std::function<MidiModule&(std::size_t)>;
    /// Loads what is there. Functions answer what went wrong, in one line, or nothing.
    std::string open(const MidisimOptions& options, const ModuleAt& module_at);
    /// Saves what has changed.
    std::string keep();

  private:
    struct File {
        std::string path;
        MidiModule* module = nullptr;
        std::uint32_t written = 0;
    };
    std::vector<File> files_;
};

/// Modules on a serial line with a client and EEPROM files. Time is given.
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
    MidiRack rack_;
    Endpoint v24_;
    EepromFiles files_;
};

/// Modules on a CAN interface of this machine.
class MidiCanService final : public Served {
  public:
    MidiCanService(const MidisimOptions& options, std::string& error);

    std::string advance(Time to) override;
    std::string endpoints() const override { return "can: " + interface_ + "\n"; }
    std::string status() const override;
    std::string finish() override;

  private:
    std::string interface_;
    std::unique_ptr<hal_linux::SocketCan> port_;
    std::unique_ptr<MidiCanRack> rack_;
    EepromFiles files_;
};

/// "MAC34-1 @0 P 1200 moves VMOT-OK TOP-ZERO status 00000000": the five LEDs by their names.
std::string describe(const MidiModule& module);

}  // namespace nplc::sim
