#pragma once

#include <cstdint>
#include <span>

#include "base/can_frame.h"

namespace nplc::ports {

using base::CanFrame;

/// Lets in the frames of one format whose identifier is `id` in the bits of `mask`, data and remote.
struct CanFilter {
    std::uint32_t id = 0;
    std::uint32_t mask = 0;
    bool extended = false;
};

enum class CanState : std::uint8_t {
    down,     ///< not in operation, or the controller is gone
    active,   ///< takes part, error active
    warning,  ///< an error counter has reached 96
    passive,  ///< an error counter has reached 128: takes part, may not destroy others' frames
    bus_off,  ///< the transmit error counter has passed 255: silent until restarted
};

/// Since the port was opened, as far as the controller tells; they stay at their greatest value.
struct CanFaults {
    std::uint32_t bus_errors = 0;  ///< bit, stuff, form, check sum, acknowledgement
    std::uint32_t overruns = 0;    ///< received frames that were lost because nobody read in time
    std::uint32_t bus_offs = 0;

    bool operator==(const CanFaults&) const = default;
};

/// One CAN controller. Its bit rate is the board's affair. No call blocks.
class CanPort {
  public:
    /// Takes a valid frame for transmission, in order. False if it did not: its queue is full, or the port is
    /// down or off the bus. What was taken and could not be sent before the port went down or off the bus is
    /// discarded.
    virtual bool write(const CanFrame& frame) = 0;

    /// The oldest received frame. False if there is none. Frames written here are not received here.
    virtual bool read(CanFrame& frame) = 0;

    /// Which frames come in from now on: those that one of them lets in, so none if there are none. Until the
    /// first call all come in. False, and nothing has changed, if they are more than the controller has.
    virtual bool filter(std::span<const CanFilter> filters) = 0;

    virtual CanState state() = 0;
    virtual CanFaults faults() = 0;

    /// Begins the return from bus_off: the controller takes part again when it has seen 128 times 11
    /// recessive bits, which `state` tells. False if it is not off the bus, or may not be restarted from
    /// here.
    virtual bool restart() = 0;

  protected:
    ~CanPort() = default;
};

}  // namespace nplc::ports
