// Loaded before the C library (LD_PRELOAD): a disk that takes SLOW_DISK_MS milliseconds, 300 if nothing is
// said, for every fdatasync.
#include <unistd.h>

#include <cstdlib>
#include <ctime>

extern "C" int fdatasync(int file) {
    const char* const said = std::getenv("SLOW_DISK_MS");
    const timespec slow{.tv_sec = 0, .tv_nsec = (said != nullptr ? std::atol(said) : 300) * 1'000'000};
    nanosleep(&slow, nullptr);
    return fsync(file);
}
