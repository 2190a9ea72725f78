#pragma once

#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "faces/axis_model.h"
#include "hal_linux/wakeup.h"
#include "modbus/session.h"

namespace nplc::modbus {

/// Modbus TCP (Modbus Messaging on TCP/IP V1.0b), in a thread of its own. Axis n of a process is unit n,
/// counted from 1; a single axis answers units 0 and 255 too. One more client than `clients` takes the place
/// of the one that has been silent for the longest time, never that of the master that operates.
class TcpServer {
  public:
    struct Options {
        std::string listen;  ///< "tcp:ADDRESS:PORT", ADDRESS as of IPv4 or, in brackets, IPv6
        std::size_t clients = 32;
        Settings settings{};
    };
    struct Opened {
        std::unique_ptr<TcpServer> server;
        std::string error;  ///< one line
    };
    /// Before the axes' loops begin; they must outlive it.
    static Opened open(const Options& options, const faces::Axes& axes);
    ~TcpServer();
    TcpServer(const TcpServer&) = delete;
    TcpServer& operator=(const TcpServer&) = delete;

    /// Where it listens, with the port that the system chose: "tcp:127.0.0.1:1502".
    const std::string& name() const { return name_; }

  private:
    class Loop;
    TcpServer();

    std::string name_;
    std::unique_ptr<Loop> loop_;
    std::thread thread_;
};

}  // namespace nplc::modbus
