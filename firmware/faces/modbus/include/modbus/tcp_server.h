#pragma once

#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "faces/axis_model.h"
#include "hal_linux/wakeup.h"
#include "modbus/session.h"

namespace nplc::modbus {

/// Modbus TCP (Modbus Messaging on TCP/IP V1.0b), in its own thread. Axis n of a process is unit n, counted
/// from 1, unless it has a unit of its own; a single axis also answers units 0 and 255. A client beyond
/// `clients` replaces the one that has been silent the longest, but never the operating master.
class TcpServer {
  public:
    struct Options {
        std::string listen;  ///< "tcp:ADDRESS:PORT", ADDRESS in IPv4 or, in brackets, IPv6
        std::size_t clients = 32;
        Settings settings{};
    };
    struct Opened {
        std::unique_ptr<TcpServer> server;
        std::string error;  ///< one line
    };
    /// To be called before the axes' loops begin; the axes must outlive it.
    static Opened open(const Options& options, const faces::Axes& axes);
    ~TcpServer();
    TcpServer(const TcpServer&) = delete;
    TcpServer& operator=(const TcpServer&) = delete;

    /// Its address with the port that the system chose: "tcp:127.0.0.1:1502".
    const std::string& name() const { return name_; }

  private:
    class Loop;
    TcpServer();

    std::string name_;
    std::unique_ptr<Loop> loop_;
    std::thread thread_;
};

}  // namespace nplc::modbus
