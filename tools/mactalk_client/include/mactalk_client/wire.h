#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "base/time.h"
#include "host/byte_client.h"

namespace nplc::mactalk_client {

/// The line to the units, with the time on it. Tests give one in virtual time.
class Wire {
  public:
    virtual ~Wire() = default;
    /// How a person knows it.
    virtual const std::string& name() const = 0;
    /// False if the other end is gone.
    virtual bool write(std::span<const std::uint8_t> bytes) = 0;
    /// Waits no longer than `wait` for a first byte; nothing if the other end is gone.
    virtual std::optional<std::size_t> read(std::span<std::uint8_t> out, base::Microseconds wait) = 0;
    virtual base::Instant now() = 0;
    /// Which other program the far end serves, "macreg (process 1234)"; empty where that cannot be told.
    virtual std::string other_client() { return {}; }
    /// As host::ByteClient does.
    using Rest = host::ByteClient::Rest;
    virtual Rest rest(base::Microseconds /*time*/) { return Rest::not_shared; }
    virtual std::string holder() { return {}; }
};

struct OpenedWire {
    std::unique_ptr<Wire> wire;
    std::string error;   ///< one line: what, where, what to do; empty when it was opened
    bool never = false;  ///< the endpoint or the speed is written wrongly
};

/// An endpoint as host::ByteClient takes it.
using Holding = host::ByteClient::Holding;
OpenedWire open_wire(const std::string& endpoint, std::uint32_t baud, Holding holding = Holding::alone);

}  // namespace nplc::mactalk_client
