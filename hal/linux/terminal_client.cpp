#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <termios.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "descriptor_client.h"
#include "port_holder.h"

namespace nplc::hal_linux {
namespace {

struct Speed {
    std::uint32_t baud;
    speed_t code;
};
constexpr std::array<Speed, 11> kSpeeds{{{1200, B1200},
                                         {2400, B2400},
                                         {4800, B4800},
                                         {9600, B9600},
                                         {19'200, B19200},
                                         {38'400, B38400},
                                         {57'600, B57600},
                                         {115'200, B115200},
                                         {230'400, B230400},
                                         {460'800, B460800},
                                         {921'600, B921600}}};

class TerminalClient final : public DescriptorClient {
  public:
    TerminalClient(FileDescriptor descriptor, const std::string& name, const termios& before)
        : DescriptorClient(std::move(descriptor), name), before_(before) {}
    ~TerminalClient() override {
        ::ioctl(descriptor(), TIOCNXCL);
        ::tcsetattr(descriptor(), TCSANOW, &before_);
    }

  private:
    termios before_;
};

/// "minicom (process 1234)"; empty if it is none that we may look into.
std::string holder(dev_t device) {
    return program_with(
        [device](const struct stat& status) { return S_ISCHR(status.st_mode) && status.st_rdev == device; });
}

std::string held(const std::string& name, const std::string& path) {
    struct stat status {};
    const std::string who = ::stat(path.c_str(), &status) == 0 ? holder(status.st_rdev) : std::string();
    return name + ": " + (who.empty() ? "another program" : who) + " holds this port; end it first";
}

std::string cannot_open(const std::string& name, const std::string& path, int reason) {
    switch (reason) {
        case EBUSY:
            return held(name, path);
        case ENOENT:
            return name + ": there is no such port; is the device connected, or its program running?";
        case EACCES:
            return name + ": you may not use this port; join the group that may (often dialout)";
        default:
            return name + ": cannot be opened: " + std::strerror(reason);
    }
}

termios raw_mode(termios mode, speed_t speed) {
    ::cfmakeraw(&mode);
    ::cfsetspeed(&mode, speed);
    mode.c_cflag |= static_cast<tcflag_t>(CLOCAL | CREAD);
    mode.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS | PARENB);
    mode.c_cc[VMIN] = 0;
    mode.c_cc[VTIME] = 0;
    return mode;
}

}  // namespace

host::ByteClient::Opened open_terminal_client(const std::string& path, const std::string& name,
                                              std::uint32_t baud) {
    const Speed* speed = nullptr;
    for (const Speed& known : kSpeeds) {
        if (known.baud == baud) speed = &known;
    }
    if (speed == nullptr)
        return {nullptr,
                name + ": no serial line has " + std::to_string(baud) +
                    " baud; take 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400, "
                    "460800 or 921600",
                true};
    FileDescriptor terminal(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (!terminal) return {nullptr, cannot_open(name, path, errno)};
    termios before{};
    if (::tcgetattr(terminal.get(), &before) != 0) return {nullptr, name + ": this is not a serial line"};
    if (::flock(terminal.get(), LOCK_EX | LOCK_NB) != 0) return {nullptr, held(name, path)};
    const termios mode = raw_mode(before, speed->code);
    if (::ioctl(terminal.get(), TIOCEXCL) != 0 || ::tcsetattr(terminal.get(), TCSANOW, &mode) != 0)
        return {nullptr, name + ": cannot be set up: " + std::strerror(errno)};
    ::tcflush(terminal.get(), TCIOFLUSH);
    return {std::make_unique<TerminalClient>(std::move(terminal), name, before), {}};
}

}  // namespace nplc::hal_linux
