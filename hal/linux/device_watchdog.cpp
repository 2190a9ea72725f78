#include <fcntl.h>
#include <linux/watchdog.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "feeding.h"
#include "file_descriptor.h"
#include "hal_linux/watchdog.h"

namespace nplc::hal_linux {
namespace {

using std::chrono::seconds;

/// Stops it. False: it cannot be stopped. The magic close is used only if the driver has no command to stop:
/// after the command the kernel would keep the permission, and the next program's crash would stop the
/// watchdog.
bool stop(int device) {
    int order = WDIOS_DISABLECARD;
    if (::ioctl(device, WDIOC_SETOPTIONS, &order) == 0) return true;
    return errno != EBUSY && ::write(device, "V", 1) == 1;
}

/// Returns the timeout now in force in seconds, also if it is fixed; 0: error in errno.
int set_timeout(int device, int wanted) {
    int made = wanted;
    if (::ioctl(device, WDIOC_SETTIMEOUT, &made) == 0) return made;
    const bool fixed = errno == EOPNOTSUPP || errno == ENOTTY;
    return fixed && ::ioctl(device, WDIOC_GETTIMEOUT, &made) == 0 ? made : 0;
}

}  // namespace

std::string DeviceWatchdog::why_not_opened(const std::string& path, int error) {
    if (error == ENOENT) return "there is no " + path + "; load the driver of this board's watchdog";
    if (error == EBUSY)
        return path + ": another program has it; systemd does if its RuntimeWatchdogSec= is set";
    if (error == EACCES) return "you may not use " + path + "; its group may, or root";
    if (error == EPERM)
        return "this service may not use " + path +
               "; name it in DeviceAllow= of nanoplc.service (`systemctl edit nanoplc`)";
    return path + ": " + std::strerror(error);
}

DeviceWatchdog::Opened DeviceWatchdog::open(const std::string& path, base::Microseconds timeout) {
    const auto wanted = std::chrono::floor<seconds>(timeout);
    if (wanted < seconds(1) || wanted > seconds(std::numeric_limits<int>::max()))
        return {nullptr, path + ": its time is at least 1 s"};
    FileDescriptor device(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (!device) return {nullptr, why_not_opened(path, errno)};
    watchdog_info info{};
    if (::ioctl(device.get(), WDIOC_GETSUPPORT, &info) != 0)
        return {nullptr, path + ": this is not a watchdog"};
    const seconds made(set_timeout(device.get(), static_cast<int>(wanted.count())));
    if (made < seconds(1) || made > wanted) {
        const std::string reason = made > wanted
                                       ? "it has " + std::to_string(made.count()) + " s; ask for those"
                                       : std::strerror(errno);
        stop(device.get());
        return {nullptr, path + ": cannot do " + std::to_string(wanted.count()) + " s: " + reason};
    }
    std::unique_ptr<DeviceWatchdog> armed(new DeviceWatchdog());
    int cause = 0;
    armed->has_reset_board_ =
        ::ioctl(device.get(), WDIOC_GETBOOTSTATUS, &cause) == 0 && (cause & WDIOF_CARDRESET) != 0;
    armed->tells_resets_ = (info.options & WDIOF_CARDRESET) != 0;
    armed->timeout_ = made;
    armed->device_ = device.release();
    armed->path_ = path;
    armed->feed();
    return {std::move(armed), {}};
}

bool DeviceWatchdog::any_has_reset_board() {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator("/sys/class/watchdog", error)) {
        int cause = 0;
        if (std::ifstream(entry.path() / "bootstatus") >> cause && (cause & WDIOF_CARDRESET) != 0)
            return true;
    }
    return false;
}

DeviceWatchdog::~DeviceWatchdog() {
    if (device_ >= 0) ::close(device_);
}

void DeviceWatchdog::feed() {
    const base::Instant now = present();
    if (device_ >= 0 && is_due(fed_, now, timeout_) && ::ioctl(device_, WDIOC_KEEPALIVE, nullptr) == 0)
        fed_ = now;
}

std::string DeviceWatchdog::disarm() {
    if (device_ < 0) return {};
    const bool stopped = stop(device_);
    ::close(device_);
    device_ = -1;
    if (stopped) return {};
    return path_ +
           ": it cannot be stopped any more (nowayout): the board resets unless another program feeds it";
}

}  // namespace nplc::hal_linux
