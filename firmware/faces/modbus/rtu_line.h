#pragma once

#include <memory>
#include <string>

#include "base/time.h"
#include "modbus/rtu_server.h"
#include "ports/serial.h"

namespace nplc::modbus {

/// A serial line of this machine, or a pseudo-terminal instead. An unplugged one is silent and is reopened.
class RtuLine {
  public:
    struct Opened {
        std::unique_ptr<RtuLine> line;
        std::string error;
    };
    static Opened open(const RtuServer::Options& options);
    virtual ~RtuLine() = default;

    /// For waiting; negative: no descriptor, poll later.
    virtual int descriptor() = 0;
    virtual std::size_t read(std::span<ports::ReceivedByte> out) = 0;
    virtual std::size_t write(std::span<const std::uint8_t> bytes) = 0;
    /// To be called regularly: tries to reopen the line.
    virtual void look() = 0;
};

}  // namespace nplc::modbus
