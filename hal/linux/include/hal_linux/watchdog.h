#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/time.h"
#include "ports/watchdog.h"

/// Two watchdogs of Linux: systemd's for the service, /dev/watchdog for the board. Either may be fed with
/// every scan: a feed is passed on when a quarter of the timeout has passed since the last one, so a program
/// that stops is detected between three quarters and the whole of the timeout after its last scan.
namespace nplc::hal_linux {

/// systemd, if it started this program as a service of Type=notify; otherwise all calls do nothing.
class ServiceWatchdog final : public ports::Watchdog {
  public:
    struct Opened {
        std::unique_ptr<ServiceWatchdog> watchdog;
        std::string error;  ///< one line: an invalid NOTIFY_SOCKET or WATCHDOG_USEC
    };
    /// Uses NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID and removes them from the environment.
    static Opened open();
    ~ServiceWatchdog();
    ServiceWatchdog(const ServiceWatchdog&) = delete;
    ServiceWatchdog& operator=(const ServiceWatchdog&) = delete;

    bool has_service() const { return socket_ >= 0; }
    /// WatchdogSec= of the unit: without a `feed` within this time the service is killed. Empty: no watchdog
    /// is configured.
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

/// The board's own. If destroyed without `disarm` it stays armed and resets the board (with a driver that
/// supports the magic close, as nearly all do).
class DeviceWatchdog final : public ports::Watchdog {
  public:
    struct Opened {
        std::unique_ptr<DeviceWatchdog> watchdog;
        std::string error;  ///< one line
    };
    /// Opening arms it. The drivers support whole seconds, and some few values only: `timeout` returns the
    /// actual one, no longer than requested.
    static Opened open(const std::string& path, base::Microseconds timeout);
    /// The reason and the remedy, one line, for the errno of an open(2) that failed.
    static std::string why_not_opened(const std::string& path, int error);
    ~DeviceWatchdog();
    DeviceWatchdog(const DeviceWatchdog&) = delete;
    DeviceWatchdog& operator=(const DeviceWatchdog&) = delete;

    base::Microseconds timeout() const { return timeout_; }
    /// The driver reports that it reset the board before this start.
    bool has_reset_board() const { return has_reset_board_; }
    /// Whether the driver can report that. Those of bcm2835, dw and sunxi chips and softdog cannot.
    bool tells_resets() const { return tells_resets_; }
    /// The driver of any watchdog of this board reports it in /sys; no device is opened, so another program
    /// may have it.
    static bool any_has_reset_board();

    void feed() override;
    /// Orderly end. Empty, or a one-line reason why it stays armed (nowayout).
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
