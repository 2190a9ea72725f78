#include <sys/ioctl.h>
#include <termios.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "descriptor_client.h"
#include "terminal_port.h"

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
    ExclusivePort port = open_exclusively(path, name);
    if (!port.error.empty()) return {nullptr, port.error};
    const int terminal = port.descriptor.get();
    termios before{};
    if (::tcgetattr(terminal, &before) != 0) return {nullptr, name + ": this is not a serial line"};
    const termios mode = raw_mode(before, speed->code);
    if (::tcsetattr(terminal, TCSANOW, &mode) != 0)
        return {nullptr, name + ": cannot be set up: " + std::strerror(errno)};
    ::tcflush(terminal, TCIOFLUSH);
    return {std::make_unique<TerminalClient>(std::move(port.descriptor), name, before), {}};
}

}  // namespace nplc::hal_linux
