#pragma once

#include <memory>
#include <string>
#include <thread>

#include "faces/axis_model.h"
#include "hal_linux/uart.h"
#include "modbus/session.h"

namespace nplc::modbus {

/// Modbus RTU (Modbus over Serial Line V1.02), in its own thread: an axis without a unit of its own has the
/// address of `unit` plus its index, beside other slaves on the line. A broadcast of a stop stops all axes;
/// other broadcasts are ignored. Stops are found behind noise too.
class RtuServer {
  public:
    struct Options {
        std::string port;  ///< /dev/ttyUSB0, or pty:PATH, which becomes a link to a terminal
        std::uint32_t baud = 19'200;
        hal_linux::Parity parity =
            hal_linux::Parity::even;  ///< without parity: two stop bits, as required by the standard
        std::optional<hal_linux::Rs485> rs485{};
        std::uint8_t unit = 1;  ///< of the first axis
        Settings settings{};
    };
    struct Opened {
        std::unique_ptr<RtuServer> server;
        std::string error;  ///< one line
    };
    /// To be called by the axes' loop, before it begins or later; the axes must outlive it.
    static Opened open(const Options& options, const faces::Axes& axes);
    ~RtuServer();
    RtuServer(const RtuServer&) = delete;
    RtuServer& operator=(const RtuServer&) = delete;

  private:
    class Loop;
    RtuServer();

    std::unique_ptr<Loop> loop_;
    std::thread thread_;
};

}  // namespace nplc::modbus
