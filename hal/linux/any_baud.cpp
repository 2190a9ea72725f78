#include "any_baud.h"

// Not <termios.h>, which defines the same names differently.
#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <sys/ioctl.h>

namespace nplc::hal_linux {

bool set_any_baud(int descriptor, std::uint32_t baud) {
    termios2 mode{};
    if (::ioctl(descriptor, TCGETS2, &mode) != 0) return false;
    constexpr unsigned kBothSpeeds = CBAUD | (CBAUD << IBSHIFT);
    mode.c_cflag = (mode.c_cflag & ~kBothSpeeds) | BOTHER | (BOTHER << IBSHIFT);
    mode.c_ispeed = mode.c_ospeed = baud;
    return ::ioctl(descriptor, TCSETS2, &mode) == 0;
}

std::uint32_t present_baud(int descriptor) {
    termios2 mode{};
    return ::ioctl(descriptor, TCGETS2, &mode) == 0 ? mode.c_ospeed : 0;
}

}  // namespace nplc::hal_linux
