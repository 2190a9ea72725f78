#include "hal_linux/latency.h"

#include <fcntl.h>
#include <linux/serial.h>
#include <sys/ioctl.h>

#include <filesystem>
#include <fstream>

#include "file_descriptor.h"

namespace nplc::hal_linux {

std::optional<Adapter> find_adapter(const std::string& path, const std::string& sysfs) {
    std::error_code error;
    const std::filesystem::path device = std::filesystem::canonical(path, error);
    if (error) return std::nullopt;
    std::string file = sysfs + "/bus/usb-serial/devices/" + device.filename().string() + "/latency_timer";
    std::int64_t milliseconds = 0;
    if (!(std::ifstream(file) >> milliseconds)) return std::nullopt;
    return Adapter{std::move(file), base::Milliseconds{milliseconds}};
}

void ask_for_low_latency(int descriptor) {
    serial_struct serial{};
    if (::ioctl(descriptor, TIOCGSERIAL, &serial) != 0) return;
    serial.flags |= static_cast<int>(ASYNC_LOW_LATENCY);
    ::ioctl(descriptor, TIOCSSERIAL, &serial);
}

void ask_for_low_latency(const std::string& path) {
    const FileDescriptor line(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (line) ask_for_low_latency(line.get());
}

}  // namespace nplc::hal_linux
