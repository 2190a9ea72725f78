#pragma once

#include <deque>
#include <optional>
#include <random>

#include "ports/can.h"
#include "sim/midi_ends.h"
#include "sim/midi_module.h"
#include "sim/serial_line.h"

namespace nplc::sim {

/// The gateway's CAN controller on a virtual bus that may lose frames.
class VirtualCanPort final : public ports::CanPort {
  public:
    VirtualCanPort(CanBus& bus, std::uint64_t seed) : bus_(bus), random_(seed) {}

    bool write(const ports::CanFrame& frame) override;
    bool read(ports::CanFrame& frame) override;
    bool filter(std::span<const ports::CanFilter> filters) override;
    ports::CanState state() override { return state_; }
    ports::CanFaults faults() override { return {}; }
    bool restart() override;

    /// A frame that has arrived.
    void receive(const base::CanFrame& frame);
    void set_state(ports::CanState state) { state_ = state; }
    /// Share of frames that are lost, in either direction.
    void lose(double share) { lose(share, share); }
    void lose(double sent, double received) {
        loss_of_sent_ = sent;
        loss_of_received_ = received;
    }
    unsigned restarts() const { return restarts_; }

  private:
    bool loses(double share) { return std::uniform_real_distribution<>(0, 1)(random_) < share; }

    CanBus& bus_;
    std::mt19937_64 random_;
    double loss_of_sent_ = 0;
    double loss_of_received_ = 0;
    ports::CanState state_ = ports::CanState::active;
    std::deque<ports::CanFrame> received_;
    std::optional<std::vector<ports::CanFilter>> filters_;
    unsigned restarts_ = 0;
};

struct MidiDriveOptions {
    registers::midi::Model model = registers::midi::Model::mac34_1;
    bool can = false;
    std::uint8_t address = 0;  ///< V24 0..7Fh, CAN 1..7Fh
    std::uint32_t rate = 0;    ///< baud or bit/s; 0: 38400 baud, 250 kbit/s
    std::uint64_t seed = 1;    ///< of the line's faults
    MidiOptions module{};      ///< `can` and `address` are taken from above
};

/// A virtual MIDI module and the line to it, with the gateway's port, in virtual time.
class MidiDrive {
  public:
    explicit MidiDrive(const MidiDriveOptions& options);

    ports::SerialPort& serial() { return line_.port(); }
    VirtualCanPort& can() { return can_port_; }
    VirtualSerialLine& line() { return line_; }
    const VirtualSerialLine& line() const { return line_; }
    MidiModule& module() { return module_; }
    const MidiModule& module() const { return module_; }

    /// Moves characters or frames, after the module was advanced to `now`. True if something has arrived at
    /// the gateway.
    bool service(Time now);
    /// Next event of the line, or of the module if it could send by itself.
    Time next_event(Time now) const;

    void cut(bool cut);
    bool is_cut() const { return cut_; }
    /// What the gateway sends is lost, what it would receive is.
    void cut(bool to_drive, bool from_drive);
    /// What the drive sends comes later by `late`, and then at the next multiple of `together`, as from a USB
    /// adapter.
    void delay(Time late, Time together);
    void power(bool on);

  private:
    bool service_v24(Time now);
    bool service_can(Time now);

    bool is_can_;
    MidiModule module_;
    VirtualSerialLine line_;
    MidiV24End v24_end_;
    MidiCanEnd can_end_;
    CanBus bus_;
    VirtualCanPort can_port_;
    bool cut_ = false;
    Time asked_{0};
    LineFaults lateness_;
    std::deque<std::pair<Time, ports::CanFrame>> coming_;  ///< and when it arrives
};

}  // namespace nplc::sim
