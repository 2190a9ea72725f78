#include "host/byte_client.h"

#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <ctime>

#include "descriptor_client.h"
#include "host/clock.h"
#include "host/endpoint.h"

namespace nplc::hal_linux {
namespace {

constexpr base::Microseconds kLongestWait = std::chrono::hours(24);  // a time_t may have 32 bits

constexpr int kWriteWaitMs = 1000;

}  // namespace

bool DescriptorClient::write(std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const ssize_t taken = ::write(descriptor(), bytes.data(), bytes.size());
        if (taken > 0) {
            bytes = bytes.subspan(static_cast<std::size_t>(taken));
            continue;
        }
        if (taken < 0 && errno == EINTR) continue;
        if (taken < 0 && errno != EAGAIN) return false;
        pollfd state{.fd = descriptor(), .events = POLLOUT, .revents = 0};
        if (::poll(&state, 1, kWriteWaitMs) == 0) return false;
    }
    return true;
}

std::optional<std::size_t> DescriptorClient::read(std::span<std::uint8_t> out, base::Microseconds wait) {
    pollfd state{.fd = descriptor(), .events = POLLIN, .revents = 0};
    const auto count = std::clamp(wait, base::Microseconds(0), kLongestWait).count();
    const timespec limit{.tv_sec = static_cast<time_t>(count / 1'000'000),
                         .tv_nsec = static_cast<long>(count % 1'000'000 * 1000)};
    if (::ppoll(&state, 1, &limit, nullptr) <= 0) return 0;
    const ssize_t got = ::read(descriptor(), out.data(), out.size());
    if (got > 0) return static_cast<std::size_t>(got);
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
    return std::nullopt;
}

base::Instant DescriptorClient::now() const {
    return host::steady_now();
}

}  // namespace nplc::hal_linux

namespace nplc::host {

ByteClient::Opened ByteClient::open(const std::string& endpoint, std::uint32_t baud, Holding holding) {
    const Endpoint line(endpoint);
    const bool is_path = endpoint.find('/') < endpoint.find(':');
    if (!line.place.empty()) {
        switch (line.kind) {
            case Endpoint::Kind::device:
                if (!is_path) break;
                [[fallthrough]];
            case Endpoint::Kind::pty:
                return hal_linux::open_terminal_client(line.place, endpoint, baud, holding);
            case Endpoint::Kind::unix_socket:
                return hal_linux::open_unix_client(line.place);
            case Endpoint::Kind::tcp:
                return hal_linux::open_tcp_client(line.place);
            case Endpoint::Kind::can:
                break;
        }
    }
    return {nullptr, "'" + endpoint + "': write " + forms(), true};
}

std::string ByteClient::forms() {
    return "a serial line's path such as /dev/ttyUSB0, or pty:PATH, unix:PATH or tcp:127.0.0.1:PORT";
}

}  // namespace nplc::host
