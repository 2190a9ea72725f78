#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "ports/can.h"

namespace nplc::hal_linux {

struct CanSettings {
    std::string interface;                   ///< can0
    std::optional<std::uint32_t> bitrate{};  ///< what the interface must be set to; it is compared, not set
};

/// A CAN interface of the kernel (SocketCAN). Who sets it up and takes it up is the system:
///     ip link set can0 type can bitrate 125000 restart-ms 100 && ip link set can0 up
/// With restart-ms the kernel returns from bus_off by itself; without, `restart` asks for it, which needs
/// CAP_NET_ADMIN. An interface that is down may be opened; it works once it is up. The kernel may keep what
/// was written (txqueuelen, 10 frames) over a bus_off that is shorter than a second, and send it then.
class SocketCan final : public ports::CanPort {
  public:
    struct Opened {
        std::unique_ptr<SocketCan> can;
        std::string error;  ///< one line, without a port
    };
    static Opened open(const CanSettings& settings);
    /// One that is gone until `reopen`.
    static std::unique_ptr<SocketCan> absent(const CanSettings& settings);
    ~SocketCan();
    SocketCan(const SocketCan&) = delete;
    SocketCan& operator=(const SocketCan&) = delete;

    bool write(const ports::CanFrame& frame) override;
    bool read(ports::CanFrame& frame) override;
    bool filter(std::span<const ports::CanFilter> filters) override;
    ports::CanState state() override;
    ports::CanFaults faults() override;
    bool restart() override;

    /// Why the last `restart` was refused, one line.
    const std::string& restart_problem() const { return restart_problem_; }

    /// Readable while a frame or a change of state waits, which `read` until it answers false takes away. The
    /// same one as long as this object lives.
    int descriptor() const;

    /// The interface does not exist any more (an adapter was pulled out): down until `reopen`.
    bool gone() const;
    /// Empty if it is back, with the filters that it had.
    std::string reopen();

  private:
    struct Inside;
    explicit SocketCan(std::unique_ptr<Inside> inside);

    std::unique_ptr<Inside> inside_;
    std::string restart_problem_{};
};

}  // namespace nplc::hal_linux
