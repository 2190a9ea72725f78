#include "hal_linux/uart.h"

#include <fcntl.h>
#include <linux/serial.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "any_baud.h"
#include "file_descriptor.h"
#include "hal_linux/latency.h"
#include "terminal_port.h"

namespace nplc::hal_linux {
namespace {

constexpr std::size_t kAtOnce = 256;

/// Drivers round the speed; a line tolerates an error of 2.5 %.
bool fits_baud(std::uint32_t made, std::uint32_t wanted) {
    const std::int64_t off = std::int64_t{made} - std::int64_t{wanted};
    return std::abs(off) * 40 <= std::int64_t{wanted};
}

/// Raw, with framing and parity errors marked.
bool set_mode(int descriptor, const UartSettings& settings) {
    termios mode{};
    if (::tcgetattr(descriptor, &mode) != 0) return false;
    mode = raw_mode(mode, B38400);
    mode.c_iflag &= ~static_cast<tcflag_t>(IGNPAR | IGNBRK | BRKINT);
    mode.c_iflag |= static_cast<tcflag_t>(PARMRK | INPCK);
    if (settings.parity != Parity::none) mode.c_cflag |= static_cast<tcflag_t>(PARENB);
    if (settings.parity == Parity::odd) mode.c_cflag |= static_cast<tcflag_t>(PARODD);
    if (settings.parity == Parity::even) mode.c_cflag &= ~static_cast<tcflag_t>(PARODD);
    if (settings.two_stop_bits) mode.c_cflag |= static_cast<tcflag_t>(CSTOPB);
    return ::tcsetattr(descriptor, TCSANOW, &mode) == 0;
}

/// A driver may apply a part of a mode without reporting an error.
bool has_flow_control(int descriptor) {
    termios mode{};
    if (::tcgetattr(descriptor, &mode) != 0) return true;
    return (mode.c_iflag & kFlowControl) != 0 || (mode.c_cflag & static_cast<tcflag_t>(CRTSCTS)) != 0;
}

bool set_rs485(int descriptor, const Rs485& wanted) {
    serial_rs485 mode{};
    mode.flags = SER_RS485_ENABLED | (wanted.rts_on_send ? SER_RS485_RTS_ON_SEND : SER_RS485_RTS_AFTER_SEND);
    mode.delay_rts_before_send = wanted.before_ms;
    mode.delay_rts_after_send = wanted.after_ms;
    return ::ioctl(descriptor, TIOCSRS485, &mode) == 0;
}

std::string set_up(int descriptor, const UartSettings& settings) {
    const std::string& path = settings.path;
    if (!set_mode(descriptor, settings)) return path + ": cannot be set up: " + std::strerror(errno);
    if (!set_any_baud(descriptor, settings.baud) || !fits_baud(present_baud(descriptor), settings.baud))
        return path + ": this device cannot do " + std::to_string(settings.baud) + " baud";
    if (settings.rs485 && !set_rs485(descriptor, *settings.rs485))
        return path + ": the driver of this device cannot do RS-485 (" + std::strerror(errno) +
               "); leave rs485 out if the adapter switches by itself";
    if (has_flow_control(descriptor))
        return path +
               ": the driver of this device keeps its flow control, which takes 11h and 13h for its own; "
               "use another adapter";
    ask_for_low_latency(descriptor);  // otherwise an FTDI adapter delays characters by 16 ms
    ::tcflush(descriptor, TCIOFLUSH);
    return {};
}

}  // namespace

Uart::Opened Uart::open(const UartSettings& settings) {
    std::unique_ptr<Uart> uart = absent(settings);
    std::string error = uart->reopen();
    if (!error.empty()) return {nullptr, std::move(error)};
    return {std::move(uart), {}};
}

std::unique_ptr<Uart> Uart::absent(const UartSettings& settings) {
    return std::unique_ptr<Uart>(new Uart(settings));
}

Uart::~Uart() {
    lose();
}

std::string Uart::reopen() {
    lose();
    OpenedPort port = open_exclusively(settings_.path, settings_.path);
    if (!port.error.empty()) return port.error;
    if (std::string error = set_up(port.descriptor.get(), settings_); !error.empty()) return error;
    descriptor_ = port.descriptor.release();
    return {};
}

void Uart::lose() {
    if (descriptor_ >= 0) {
        ::ioctl(descriptor_, TIOCNXCL);
        ::close(descriptor_);
    }
    descriptor_ = -1;
    mark_ = Mark::none;
}

std::size_t Uart::write(std::span<const std::uint8_t> bytes) {
    if (gone()) return bytes.size();
    const ssize_t taken = ::write(descriptor_, bytes.data(), bytes.size());
    if (taken >= 0) return static_cast<std::size_t>(taken);
    if (errno == EAGAIN || errno == EINTR) return 0;
    lose();
    return bytes.size();
}

std::size_t Uart::read(std::span<ports::ReceivedByte> out) {
    std::array<std::uint8_t, kAtOnce> buffer{};
    if (gone() || out.empty()) return 0;
    const ssize_t got = ::read(descriptor_, buffer.data(), std::min(buffer.size(), out.size()));
    if (got > 0) return unmarked(std::span(buffer).first(static_cast<std::size_t>(got)), out);
    // With VMIN 0 an empty line reads as 0 bytes too, and so does an adapter that hung up.
    int waiting = 0;
    const bool there =
        got == 0 ? ::ioctl(descriptor_, FIONREAD, &waiting) == 0 : errno == EAGAIN || errno == EINTR;
    if (!there) lose();
    return 0;
}

std::size_t Uart::unmarked(std::span<const std::uint8_t> bytes, std::span<ports::ReceivedByte> out) {
    std::size_t count = 0;
    for (const std::uint8_t byte : bytes) {
        switch (mark_) {
            case Mark::none:
                if (byte == 0xFF)
                    mark_ = Mark::begun;
                else
                    out[count++] = {byte, false};
                break;
            case Mark::begun:
                mark_ = byte == 0x00 ? Mark::error : Mark::none;
                if (byte == 0xFF) out[count++] = {byte, false};
                break;
            case Mark::error:
                mark_ = Mark::none;
                out[count++] = {byte, true};
                break;
        }
    }
    return count;
}

/// The buffer is empty, and also the shift register if the driver reports it.
bool Uart::transmitter_idle() {
    int waiting = 0;
    if (gone() || ::ioctl(descriptor_, TIOCOUTQ, &waiting) != 0) return true;
    if (waiting != 0) return false;
    unsigned state = 0;
    if (::ioctl(descriptor_, TIOCSERGETLSR, &state) != 0) return true;
    return (state & TIOCSER_TEMT) != 0;
}

}  // namespace nplc::hal_linux
