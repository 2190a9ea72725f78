#include "link_messages.h"

#include <fmt/format.h>

namespace nplc::boards {

void LinkMessages::lost(base::Instant now) {
    is_up_ = false;
    if (!minute_) minute_ = now;
    if (++losses_ > kWhole) is_limited_ = true;
}

std::optional<std::string> LinkMessages::count(base::Instant now) {
    if (!minute_ || now - *minute_ < kMinute) return std::nullopt;
    const bool was_limited = is_limited_;
    const std::uint32_t losses = losses_;
    is_limited_ = was_limited && losses > kWhole;
    minute_.reset();
    losses_ = 0;
    if (!was_limited) return std::nullopt;
    if (is_limited_) minute_ = now;
    return fmt::format("the link to the motor was lost {} time{} in the last minute; {}{}", losses,
                       losses == 1 ? "" : "s",
                       is_up_ ? "the motor answers now" : "the motor does not answer now",
                       is_limited_ ? "; each loss is counted and not told until there are fewer" : "");
}

}  // namespace nplc::boards
