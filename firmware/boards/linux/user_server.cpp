#include "user_server.h"

#include <algorithm>

namespace nplc::boards {
namespace {

constexpr std::size_t kMostClients = 8;

SharedLine::Time line_time(base::Instant now) {
    return now.time_since_epoch();
}

}  // namespace

std::string UserServer::open(const std::string& endpoint) {
    auto opened = hal_linux::ByteServer::open(endpoint, kMostClients);
    server_ = std::move(opened.server);
    if (server_) line_ = std::make_unique<SharedLine>(*server_);
    return opened.error;
}

void UserServer::take_in(base::Instant now, const SharedLine::Addresses& addresses) {
    now_ = line_time(now);
    const auto bytes = line_->to_line(now_, addresses);
    waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
}

base::Instant UserServer::next_turn(base::Instant now) const {
    if (!waiting_.empty()) return now;
    const auto next = line_->next_turn(line_time(now));
    if (!next) return base::kNever;
    return base::Instant(std::chrono::ceil<base::Microseconds>(*next));
}

std::size_t UserServer::write(std::span<const std::uint8_t> bytes) {
    line_->from_line(bytes, now_);
    return bytes.size();
}

std::size_t UserServer::read(std::span<ports::ReceivedByte> out) {
    const std::size_t count = std::min(out.size(), waiting_.size());
    for (std::size_t i = 0; i < count; ++i) {
        out[i] = {waiting_.front(), false};
        waiting_.pop_front();
    }
    return count;
}

}  // namespace nplc::boards
