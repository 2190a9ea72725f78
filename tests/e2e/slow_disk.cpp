// Loaded before the C library (LD_PRELOAD): a disk that takes 300 ms for every fdatasync.
#include <unistd.h>

#include <ctime>

extern "C" int fdatasync(int file) {
    constexpr timespec kSlow{.tv_sec = 0, .tv_nsec = 300'000'000};
    nanosleep(&kSlow, nullptr);
    return fsync(file);
}
