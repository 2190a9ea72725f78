#include "host/files.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "file_descriptor.h"

namespace nplc::host {
namespace {

constexpr std::size_t kMostOfADevice = std::size_t{4} * 1024 * 1024;

using Take = std::function<bool(std::string_view block)>;

std::string too_long(std::size_t most) {
    return "it has more than " + std::to_string(most) + " bytes";
}

/// Waits until there is data or the end.
bool await(int descriptor) {
    pollfd state{.fd = descriptor, .events = POLLIN, .revents = 0};
    return ::poll(&state, 1, -1) > 0;
}

/// `read` counts the bytes.
std::string read_to_end(int descriptor, std::size_t most, std::size_t& read, const Take& take) {
    std::array<char, 65'536> block{};
    for (;;) {
        const ssize_t count = ::read(descriptor, block.data(), block.size());
        if (count == 0) return {};
        if (count < 0 && errno == EAGAIN && await(descriptor)) continue;
        if (count < 0) return std::strerror(errno);
        read += static_cast<std::size_t>(count);
        if (read > most) return too_long(most);
        if (!take({block.data(), static_cast<std::size_t>(count)})) return {};
    }
}

}  // namespace

std::string read_blocks(const std::string& name, std::size_t most, const Take& take) {
    // Opening a pipe without a writer would wait for one.
    const hal_linux::FileDescriptor file(::open(name.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    struct stat status {};
    if (!file || ::fstat(file.get(), &status) != 0) return std::strerror(errno);
    if (S_ISDIR(status.st_mode)) return "it is a folder";
    if (S_ISREG(status.st_mode) && status.st_size > static_cast<off_t>(most)) return too_long(most);
    const bool has_end = S_ISREG(status.st_mode) || S_ISFIFO(status.st_mode);
    std::size_t read = 0;
    std::string problem =
        read_to_end(file.get(), has_end ? most : std::min(most, kMostOfADevice), read, take);
    if (S_ISFIFO(status.st_mode) && read == 0 && problem.empty())
        return "it is a pipe, and nobody writes to it";
    return problem;
}

std::FILE* create_file(const std::string& name) {
    hal_linux::FileDescriptor file(::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (!file) return nullptr;
    std::FILE* const stream = ::fdopen(file.get(), "wb");
    if (stream != nullptr) file.release();
    return stream;
}

}  // namespace nplc::host
