#include "user_server.h"

#include <algorithm>
#include <utility>

namespace nplc::boards {
namespace {

constexpr std::size_t kMostClients = 32;

SharedLine::Time line_time(base::Instant now) {
    return now.time_since_epoch();
}

}  // namespace

std::string UserServer::open(const std::string& endpoint, hal_linux::ByteServer::Settings settings,
                             faces::Seat* operators, const std::string& password) {
    settings.seats = kMostClients;
    auto opened = hal_linux::ByteServer::open(endpoint, settings);
    server_ = std::move(opened.server);
    if (server_) line_ = std::make_unique<SharedLine>(*server_, operators, password);
    return opened.error;
}

void UserServer::take_in(const SharedLine::Addresses& addresses) {
    const auto bytes = line_->to_line(now_, addresses);
    waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
}

base::Instant UserServer::next_turn(base::Instant now) const {
    if (!waiting_.empty()) return now;
    return base::Instant(std::chrono::ceil<base::Microseconds>(line_->next_turn(line_time(now))));
}

std::size_t UserServer::write(std::span<const std::uint8_t> bytes) {
    line_->from_line(bytes, now_);
    return bytes.size();
}

std::size_t UserServer::read(std::span<ports::ReceivedByte> out) {
    if (look_for_) take_in(*std::exchange(look_for_, std::nullopt));
    const std::size_t count = std::min(out.size(), waiting_.size());
    for (std::size_t i = 0; i < count; ++i) {
        out[i] = {waiting_.front(), false};
        waiting_.pop_front();
    }
    return count;
}

}  // namespace nplc::boards
