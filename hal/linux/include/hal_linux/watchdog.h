#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/time.h"
#include "ports/watchdog.h"

/// Two watchdogs of Linux: systemd watches the service, /dev/watchdog the board. Either may be fed with every
/// scan: it hands on what makes a quarter of its time since the last one, so a program that stops is noticed
/// between three quarters and the whole of the time after its last scan.
namespace nplc::hal_linux {

/// systemd, when it started this program as a service of Type=notify; without it all calls do nothing.
class ServiceWatchdog final : public ports::Watchdog {
  public:
    struct Opened {
        std::unique_ptr<ServiceWatchdog> watchdog;
        std::string error;  ///< one line: a NOTIFY_SOCKET or WATCHDOG_USEC that makes no sense
    };
    /// By NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID, which it takes out of the environment.
    static Opened open();
    ~ServiceWatchdog();
    ServiceWatchdog(const ServiceWatchdog&) = delete;
    ServiceWatchdog& operator=(const ServiceWatchdog&) = delete;

    bool has_service() const { return socket_ >= 0; }
    /// WatchdogSec= of the unit: `feed` is wanted at least this often, or the service is killed. Nothing: no
    /// watchdog is wanted.
    std::optional<base::Microseconds> timeout() const { return timeout_; }

    void feed() override;
    void ready();
    void stopping();
    /// One line, for `systemctl status`.
    void status(const std::string& line);

  private:
    ServiceWatchdog() = default;
    bool tell(const std::string& message);

    int socket_ = -1;
    std::string place_{};
    std::optional<base::Microseconds> timeout_{};
    std::optional<base::Instant> fed_{};
};

/// The board's own. Destroyed without `disarm` it stays armed, and resets the board (of a driver that knows
/// the magic close, as nearly all do).
class DeviceWatchdog final : public ports::Watchdog {
  public:
    struct Opened {
        std::unique_ptr<DeviceWatchdog> watchdog;
        std::string error;  ///< one line
    };
    /// Opening arms it. The drivers know whole seconds, and some but few values: `timeout` tells which it is,
    /// no longer than asked for.
    static Opened open(const std::string& path, base::Microseconds timeout);
    ~DeviceWatchdog();
    DeviceWatchdog(const DeviceWatchdog&) = delete;
    DeviceWatchdog& operator=(const DeviceWatchdog&) = delete;

    base::Microseconds timeout() const { return timeout_; }
    /// The driver says that it reset the board before this start.
    bool has_reset_board() const { return has_reset_board_; }
    /// The driver can say so. Those of bcm2835, dw and sunxi chips and softdog cannot.
    bool tells_resets() const { return tells_resets_; }
    /// The driver of any watchdog of this board says so in /sys; none is opened, and whoever feeds it may
    /// have it.
    static bool any_has_reset_board();

    void feed() override;
    /// The orderly end. Empty; or one line why it stays armed (nowayout).
    std::string disarm();

  private:
    DeviceWatchdog() = default;

    int device_ = -1;
    std::string path_{};
    base::Microseconds timeout_{};
    std::optional<base::Instant> fed_{};
    bool has_reset_board_ = false;
    bool tells_resets_ = false;
};

}  // namespace nplc::hal_linux
