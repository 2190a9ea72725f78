#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <cstring>

#include "feeding.h"
#include "hal_linux/watchdog.h"

namespace nplc::hal_linux {
namespace {

/// Removes the variable, so that child processes do not use it.
std::optional<std::string> take_variable(const char* name) {
    const char* value = std::getenv(name);
    if (value == nullptr) return std::nullopt;
    std::string copy = value;
    ::unsetenv(name);
    return copy;
}

std::optional<std::int64_t> whole_number(const std::string& text) {
    std::int64_t number = 0;
    const char* end = text.data() + text.size();
    if (std::from_chars(text.data(), end, number).ptr != end || number <= 0) return std::nullopt;
    return number;
}

/// A path, or @name of an abstract socket.
bool is_place(const std::string& place) {
    return place.size() > 1 && (place[0] == '/' || place[0] == '@') &&
           place.size() < sizeof(sockaddr_un::sun_path);
}

}  // namespace

ServiceWatchdog::Opened ServiceWatchdog::open() {
    std::unique_ptr<ServiceWatchdog> made(new ServiceWatchdog());
    const auto place = take_variable("NOTIFY_SOCKET");
    const auto time = take_variable("WATCHDOG_USEC");
    const auto process = take_variable("WATCHDOG_PID");
    if (!place) return {std::move(made), {}};
    if (!is_place(*place)) return {nullptr, "NOTIFY_SOCKET=" + *place + " is neither a path nor @name"};
    const bool for_us = !process || whole_number(*process) == ::getpid();
    if (time && for_us) {
        const auto microseconds = whole_number(*time);
        if (!microseconds) return {nullptr, "WATCHDOG_USEC=" + *time + " is not a number of microseconds"};
        made->timeout_ = base::Microseconds(*microseconds);
    }
    made->place_ = *place;
    made->socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (made->socket_ < 0)
        return {nullptr, std::string("no socket to tell the service manager: ") + std::strerror(errno)};
    return {std::move(made), {}};
}

ServiceWatchdog::~ServiceWatchdog() {
    if (socket_ >= 0) ::close(socket_);
}

bool ServiceWatchdog::tell(const std::string& message) {
    if (socket_ < 0) return false;
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::copy(place_.begin(), place_.end(), address.sun_path);
    if (place_[0] == '@') address.sun_path[0] = '\0';
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + place_.size());
    return ::sendto(socket_, message.data(), message.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                    reinterpret_cast<const sockaddr*>(&address), size) >= 0;
}

void ServiceWatchdog::feed() {
    if (!timeout_) return;
    const base::Instant now = present();
    if (is_due(fed_, now, *timeout_) && tell("WATCHDOG=1")) fed_ = now;
}

void ServiceWatchdog::ready() {
    tell("READY=1");
}

void ServiceWatchdog::stopping() {
    tell("STOPPING=1");
}

void ServiceWatchdog::status(const std::string& line) {
    std::string message = "STATUS=" + line;
    std::replace(message.begin(), message.end(), '\n', ' ');
    tell(message);
}

}  // namespace nplc::hal_linux
