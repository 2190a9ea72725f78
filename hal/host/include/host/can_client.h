#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/time.h"
#include "ports/can.h"

namespace nplc::host {

/// A client of a CAN bus that the system has configured and started: it waits for frames.
class CanClient {
  public:
    struct Opened {
        std::unique_ptr<CanClient> client;
        std::string error;   ///< the error and its remedy, one line; empty when it was opened
        bool never = false;  ///< not supported on this system
    };
    /// `interface`: can0, vcan0. Not on Windows.
    static Opened open(const std::string& interface);
    /// For help texts: the form of such a port on this system; empty if not supported.
    static std::string forms();

    virtual ~CanClient() = default;
    CanClient(const CanClient&) = delete;
    CanClient& operator=(const CanClient&) = delete;

    /// "can:can0"
    virtual const std::string& name() const = 0;
    /// False if the frame was not accepted within a second: the bus is down or off, or there is no other
    /// node.
    virtual bool write(const ports::CanFrame& frame) = 0;
    /// Waits up to `wait`; empty if no frame came.
    virtual std::optional<ports::CanFrame> read(base::Microseconds wait) = 0;
    virtual ports::CanState state() = 0;
    /// The interface does not exist any more.
    virtual bool gone() const = 0;
    /// Monotonic.
    virtual base::Instant now() const = 0;

  protected:
    CanClient() = default;
};

}  // namespace nplc::host
