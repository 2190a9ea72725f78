#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "sim/client_line.h"
#include "sim/midi_v24_end.h"

namespace nplc::sim {

struct MidiUnit {
    registers::midi::Model model = registers::midi::Model::mac34_1;
    std::uint8_t address = 0;
};

/// Virtual modules on one serial line, in virtual time. The same calls give the same bytes.
class MidiRack {
  public:
    /// `baud` is the client's; 0: it follows the first module's, as a client does that changes its own with
    /// it.
    MidiRack(const std::vector<MidiUnit>& units, std::uint32_t baud);

    Time now() const { return now_; }
    /// Waits for the line to be free; beyond 64 KiB it is lost.
    void send(std::span<const std::uint8_t> bytes) { line_.send(bytes); }
    void advance(Time to);
    /// What has arrived at the client since the last call.
    std::vector<std::uint8_t> received() { return line_.received(); }
    std::uint32_t baud() const { return baud_; }

    std::size_t size() const { return modules_.size(); }
    MidiModule& module(std::size_t unit) { return modules_[unit]; }
    const MidiModule& module(std::size_t unit) const { return modules_[unit]; }

  private:
    void follow_baud();
    void serve();

    bool follows_;
    std::uint32_t baud_;
    std::deque<MidiModule> modules_;
    std::vector<MidiV24End> ends_;
    ClientLine line_;
    Time now_{0};
};

}  // namespace nplc::sim
