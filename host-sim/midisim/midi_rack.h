#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "ports/can.h"
#include "sim/client_line.h"
#include "sim/midi_ends.h"

namespace nplc::sim {

struct MidiUnit {
    registers::midi::Model model = registers::midi::Model::mac34_1;
    std::uint8_t address = 0;
};

/// Virtual modules with their ends of a line.
template <class End>
class MidiModules {
  public:
    std::size_t size() const { return modules_.size(); }
    MidiModule& module(std::size_t unit) { return modules_[unit]; }
    const MidiModule& module(std::size_t unit) const { return modules_[unit]; }

  protected:
    MidiModules(const std::vector<MidiUnit>& units, bool can) {
        for (const MidiUnit& unit : units)
            modules_.emplace_back(unit.model, MidiOptions{.can = can, .address = unit.address});
        for (MidiModule& module : modules_) ends_.emplace_back(module);
    }

    std::deque<MidiModule> modules_;
    std::deque<End> ends_;
};

/// Virtual modules on one serial line, in virtual time. The same calls give the same bytes.
class MidiRack final : public MidiModules<MidiV24End> {
  public:
    /// `baud` is the client's; 0: it follows the first module's, like a client that changes its baud rate
    /// together with the module.
    MidiRack(const std::vector<MidiUnit>& units, std::uint32_t baud);

    Time now() const { return now_; }
    /// Queued until the line is free; beyond 64 KiB bytes are lost.
    void send(std::span<const std::uint8_t> bytes) { line_.send(bytes); }
    void advance(Time to);
    /// What has arrived at the client since the last call.
    std::vector<std::uint8_t> received() { return line_.received(); }
    std::uint32_t baud() const { return baud_; }

  private:
    void follow_baud();
    void serve();

    bool follows_;
    std::uint32_t baud_;
    ClientLine line_;
    Time now_{0};
};

/// Virtual modules on a CAN port. The bus is that of the port; the modules' own time is virtual.
class MidiCanRack final : public MidiModules<MidiCanEnd> {
  public:
    MidiCanRack(const std::vector<MidiUnit>& units, ports::CanPort& port);

    /// Receives frames, advances the time, sends frames. Frames that the port does not accept wait; when
    /// bus-off they are dropped, as by a module that is reset, and once a second a restart of the port is
    /// requested (R).
    void advance(Time to);

  private:
    void receive();
    void transmit();

    ports::CanPort& port_;
    std::deque<ports::CanFrame> waiting_;
    Time now_{0};
    Time next_restart_{0};
};

}  // namespace nplc::sim
