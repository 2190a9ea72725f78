#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "ports/can.h"

namespace nplc::hal_linux {

struct CanSettings {
    std::string interface;                   ///< can0
    std::optional<std::uint32_t> bitrate{};  ///< the required bit rate; it is compared, not set
};

/// A CAN interface of the kernel (SocketCAN). The system configures and starts it:
///     ip link set can0 type can bitrate 125000 restart-ms 100 && ip link set can0 up
/// With restart-ms the kernel returns from bus_off by itself; without it `restart` requests that, which needs
/// CAP_NET_ADMIN. An interface that is down can be opened; it works once it is up. The kernel may keep queued
/// frames (txqueuelen, 10 frames) during a bus_off of less than a second, and send them then.
class SocketCan final : public ports::CanPort {
  public:
    struct Opened {
        std::unique_ptr<SocketCan> can;
        std::string error;  ///< one line, if there is no port
    };
    static Opened open(const CanSettings& settings);
    /// A port that is missing until `reopen`.
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

    /// Why the last `restart` failed, one line.
    const std::string& restart_problem() const { return restart_problem_; }

    /// Readable while a frame or a change of state is pending; `read` until it returns false clears it. The
    /// same descriptor while this object lives.
    int descriptor() const;

    /// The interface no longer exists (unplugged adapter): down until `reopen`.
    bool gone() const;
    /// Empty if it is back, with its previous filters.
    std::string reopen();

  private:
    struct Inside;
    explicit SocketCan(std::unique_ptr<Inside> inside);

    std::unique_ptr<Inside> inside_;
    std::string restart_problem_{};
};

}  // namespace nplc::hal_linux
