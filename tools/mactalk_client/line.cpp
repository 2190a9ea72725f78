#include "mactalk_client/line.h"

#include <fmt/format.h>

#include "host/endpoint.h"

namespace nplc::mactalk_client {
namespace {

constexpr base::Microseconds kLongestDrain{2'000'000};

}  // namespace

base::Microseconds Line::time_of(std::size_t bytes) const {
    return base::Microseconds{static_cast<std::int64_t>(bytes) * 10'000'000 / options_.baud};
}

void Line::send(std::span<const std::uint8_t> bytes) {
    if (!port_.write(bytes)) gone();
    ++sent_;
}

void Line::expect_late_answer() {
    late_answer_ = true;
    silent_since_ = now();
}

std::uint64_t Line::settle(bool in_silence) {
    std::array<std::uint8_t, 256> bytes{};
    const base::Instant last = std::min(now() + kLongestDrain, deadline_);
    std::uint64_t stray = 0;
    for (;;) {
        const base::Instant time = now();
        const base::Instant silent = silent_since_ + options_.patience;
        const bool waits = late_answer_ && in_silence && time < silent && time < last;
        const std::size_t count = receive(bytes, waits ? silent - time : base::Microseconds{0});
        stray += count;
        if ((count == 0 && !waits) || now() >= last) break;
    }
    if (in_silence) late_answer_ = false;
    return stray;
}

std::uint64_t Line::pause(base::Microseconds time) {
    const base::Instant end = now() + time;
    std::array<std::uint8_t, 256> bytes{};
    std::uint64_t stray = 0;
    for (base::Instant t = now(); t < end; t = now()) stray += receive(bytes, end - t);
    return stray;
}

std::size_t Line::receive(std::span<std::uint8_t> out, base::Microseconds wait) {
    const auto count = port_.read(out, wait);
    if (!count) gone();
    if (*count == 0) return 0;
    heard_any_ = true;
    silent_since_ = now();
    if (options_.received) options_.received(out.first(*count));
    return *count;
}

void Line::gone() {
    const bool socket = host::Endpoint(name()).is_socket();
    const bool turned_away = socket && sent_ <= 1 && !heard_any_;
    const std::string other = turned_away ? port_.other_client() : std::string();
    if (!other.empty())
        throw LineError(
            LineError::Kind::port_gone,
            fmt::format("{}: {}, and {} is connected; end that one first", name(), options_.full, other));
    throw LineError(LineError::Kind::port_gone,
                    fmt::format("{}: the other end closed the connection{}", name(),
                                turned_away ? fmt::format(" before anything came: {}", options_.perhaps_full)
                                : socket    ? "; has its program ended?"
                                            : "; was the device unplugged, or its program ended?"));
}

}  // namespace nplc::mactalk_client
