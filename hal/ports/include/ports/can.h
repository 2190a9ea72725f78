#pragma once

#include <cstdint>
#include <span>

#include "base/can_frame.h"

namespace nplc::ports {

using base::CanFrame;

/// Accepts frames of one format whose identifier equals `id` in the bits of `mask`, data and remote.
struct CanFilter {
    std::uint32_t id = 0;
    std::uint32_t mask = 0;
    bool extended = false;
};

enum class CanState : std::uint8_t {
    down,     ///< not in operation, or the controller is missing
    active,   ///< takes part, error active
    warning,  ///< an error counter has reached 96
    passive,  ///< an error counter has reached 128: takes part, may not destroy others' frames
    bus_off,  ///< the transmit error counter has passed 255: silent until restarted
};

/// Counts since the port was opened, as far as the controller reports them; they stop at their maximum.
struct CanFaults {
    std::uint32_t bus_errors = 0;  ///< bit, stuff, form, check sum, acknowledgement
    std::uint32_t overruns = 0;    ///< received frames lost because they were not read in time
    std::uint32_t bus_offs = 0;

    bool operator==(const CanFaults&) const = default;
};

/// One CAN controller. Its bit rate is set by the board. No call blocks.
class CanPort {
  public:
    /// Queues a valid frame for transmission, in order. False if it was not accepted: the queue is full, or
    /// the port is down or bus-off. Frames not sent before the port goes down or bus-off are discarded.
    virtual bool write(const CanFrame& frame) = 0;

    /// The oldest received frame. False if there is none. Frames written here are not received here.
    virtual bool read(CanFrame& frame) = 0;

    /// Accepts only frames that match one of the filters; none if there are no filters. Before the first call
    /// all frames are accepted. False, without a change, if there are more filters than the controller
    /// supports.
    virtual bool filter(std::span<const CanFilter> filters) = 0;

    virtual CanState state() = 0;
    virtual CanFaults faults() = 0;

    /// Begins the return from bus_off: the controller takes part again after 128 times 11 recessive bits,
    /// which `state` shows. False if it is not bus-off, or may not be restarted here.
    virtual bool restart() = 0;

  protected:
    ~CanPort() = default;
};

}  // namespace nplc::ports
