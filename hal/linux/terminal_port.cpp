#include "terminal_port.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>

#include "port_holder.h"

namespace nplc::hal_linux {
namespace {

std::string cannot_open(const std::string& name, const std::string& path, int reason) {
    switch (reason) {
        case EBUSY:
            return held_by_another(name, path);
        case ENOENT:
            return name + ": there is no such port; is the device connected, or its program running?";
        case EACCES:
            return name + ": you may not use this port; join the group that may (often dialout)";
        default:
            return name + ": cannot be opened: " + std::strerror(reason);
    }
}

}  // namespace

termios raw_mode(termios mode, speed_t speed) {
    ::cfmakeraw(&mode);
    ::cfsetspeed(&mode, speed);
    mode.c_iflag &= ~kFlowControl;
    mode.c_cflag |= static_cast<tcflag_t>(CLOCAL | CREAD);
    mode.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS | PARENB);
    mode.c_cc[VMIN] = 0;
    mode.c_cc[VTIME] = 0;
    return mode;
}

std::string holder_of(const std::string& path) {
    struct stat port {};
    if (::stat(path.c_str(), &port) != 0) return {};
    return program_with(
        [&](const struct stat& status) { return S_ISCHR(status.st_mode) && status.st_rdev == port.st_rdev; });
}

std::string held_by_another(const std::string& name, const std::string& path) {
    const std::string who = holder_of(path);
    return name + ": " + (who.empty() ? "another program" : who) + " holds this port; end it first";
}

OpenedPort open_unheld(const std::string& path, const std::string& name) {
    FileDescriptor terminal(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (!terminal) return {{}, cannot_open(name, path, errno)};
    termios mode{};
    if (::tcgetattr(terminal.get(), &mode) != 0) return {{}, name + ": this is not a serial line"};
    return {std::move(terminal), {}};
}

OpenedPort open_exclusively(const std::string& path, const std::string& name) {
    OpenedPort port = open_unheld(path, name);
    if (!port.descriptor) return port;
    if (::flock(port.descriptor.get(), LOCK_EX | LOCK_NB) != 0) return {{}, held_by_another(name, path)};
    if (::ioctl(port.descriptor.get(), TIOCEXCL) != 0)
        return {{}, name + ": cannot be set up: " + std::strerror(errno)};
    return port;
}

}  // namespace nplc::hal_linux
