// Loaded before the C library (LD_PRELOAD): serial lines that can do 115200 baud at the most.
#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <dlfcn.h>

#include <cerrno>
#include <cstdarg>

extern "C" int ioctl(int descriptor, unsigned long request, ...) noexcept {
    std::va_list arguments;
    va_start(arguments, request);
    void* const argument = va_arg(arguments, void*);
    va_end(arguments);
    if (request == TCSETS2 && static_cast<const termios2*>(argument)->c_ospeed > 115'200) {
        errno = EINVAL;
        return -1;
    }
    using Ioctl = int (*)(int, unsigned long, void*);
    static const auto next = reinterpret_cast<Ioctl>(dlsym(RTLD_NEXT, "ioctl"));
    return next(descriptor, request, argument);
}
