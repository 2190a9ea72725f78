#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/time.h"
#include "ports/can.h"

namespace nplc::host {

/// Our end of a CAN bus that the system has set up and taken up, as a client: it waits for frames.
class CanClient {
  public:
    struct Opened {
        std::unique_ptr<CanClient> client;
        std::string error;   ///< what went wrong and what to do, in one line; empty when it was opened
        bool never = false;  ///< this system has no such thing
    };
    /// `interface`: can0, vcan0. Not on Windows.
    static Opened open(const std::string& interface);
    /// For the user: how such a port is written here; empty where there are none.
    static std::string forms();

    virtual ~CanClient() = default;
    CanClient(const CanClient&) = delete;
    CanClient& operator=(const CanClient&) = delete;

    /// "can:can0"
    virtual const std::string& name() const = 0;
    /// False if it was not taken within a second: the bus is down or off, or nobody else is on it.
    virtual bool write(const ports::CanFrame& frame) = 0;
    /// Waits no longer than `wait`; nothing if no frame came.
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
