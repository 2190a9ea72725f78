#pragma once

#include <memory>
#include <string>

#include "base/time.h"
#include "modbus/rtu_server.h"
#include "ports/serial.h"

namespace nplc::modbus {

/// A serial line of this machine, or a pseudo-terminal that stands in for one. One that is pulled out is
/// silent, and looked for again.
class RtuLine {
  public:
    struct Opened {
        std::unique_ptr<RtuLine> line;
        std::string error;
    };
    static Opened open(const RtuServer::Options& options);
    virtual ~RtuLine() = default;

    /// To sleep for bytes; negative: there is nothing to wait for, look again after a while.
    virtual int descriptor() = 0;
    virtual std::size_t read(std::span<ports::ReceivedByte> out) = 0;
    virtual std::size_t write(std::span<const std::uint8_t> bytes) = 0;
    /// Now and then: whether it is back.
    virtual void look() = 0;
};

}  // namespace nplc::modbus
