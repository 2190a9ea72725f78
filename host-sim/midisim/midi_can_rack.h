#pragma once

#include <deque>
#include <vector>

#include "midi_rack.h"
#include "ports/can.h"
#include "sim/midi_can_end.h"

namespace nplc::sim {

/// Virtual modules on a CAN port. The bus is whatever the port is; the modules' own time is virtual.
class MidiCanRack {
  public:
    MidiCanRack(const std::vector<MidiUnit>& units, ports::CanPort& port);

    /// Frames in, time on, frames out. What the port does not take waits; off the bus it is dropped, as by a
    /// module that is reset, and once a second the port is asked to come back (R).
    void advance(Time to);

    std::size_t size() const { return modules_.size(); }
    MidiModule& module(std::size_t unit) { return modules_[unit]; }
    const MidiModule& module(std::size_t unit) const { return modules_[unit]; }

  private:
    void hear();
    void speak();

    ports::CanPort& port_;
    std::deque<MidiModule> modules_;
    std::deque<MidiCanEnd> ends_;
    std::deque<ports::CanFrame> waiting_;
    Time now_{0};
    Time next_restart_{0};
};

}  // namespace nplc::sim
