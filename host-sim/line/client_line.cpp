#include "sim/client_line.h"

#include <algorithm>

namespace nplc::sim {
namespace {

constexpr std::size_t kMostWaiting = 64 * 1024;

}  // namespace

void ClientLine::send(std::span<const std::uint8_t> bytes) {
    const std::size_t room = kMostWaiting - std::min(kMostWaiting, waiting_.size());
    const auto taken = bytes.first(std::min(room, bytes.size()));
    waiting_.insert(waiting_.end(), taken.begin(), taken.end());
}

void ClientLine::start(Time now) {
    if (waiting_.empty() || !to_device.free(now)) return;
    to_device.start(waiting_.front(), now);
    waiting_.pop_front();
}

void ClientLine::collect(Time now) {
    while (const auto byte = from_device.take(now)) received_.push_back(byte->value);
}

Time ClientLine::next_event(Time limit) const {
    if (!waiting_.empty()) limit = std::min(limit, to_device.busy_until());
    if (const auto arrival = to_device.next_arrival()) limit = std::min(limit, *arrival);
    if (const auto arrival = from_device.next_arrival()) limit = std::min(limit, *arrival);
    return limit;
}

void ClientLine::set_baud(std::uint32_t baud) {
    to_device = LineDirection(baud, 1);
    from_device = LineDirection(baud, 1);
}

bool ClientLine::is_quiet(Time now) const {
    return to_device.free(now) && from_device.free(now) && !to_device.next_arrival() &&
           !from_device.next_arrival();
}

}  // namespace nplc::sim
