#include "stop_messages.h"

#include <fmt/format.h>

#include <algorithm>

namespace nplc::boards {

std::optional<StopMessages::Message> StopMessages::look(const Look& look, base::Instant now) {
    has_answered_ = has_answered_ || look.link_is_usable;
    if (look.is_unconfirmed) {
        if (!warn_at_) begin(look, now);
        is_over_ = false;
        if (is_told_ || now < *warn_at_) return std::nullopt;
        is_told_ = true;
        return Message{
            {LogLevel::warning,
             "the motor has not confirmed the stop for 1 s: it may be moving; look at the machine, "
             "and at the motor's supply and its line; the stop is repeated until it is confirmed, or "
             "until `nanoctl give-up-stop`"},
            JournalEvent::stop_unconfirmed};
    }
    if (!warn_at_) return std::nullopt;
    is_logged_ = is_logged_ || look.is_logged;
    const bool is_given_up = !is_logged_ && this->is_given_up(look);
    if (!is_logged_ && !is_given_up && !is_over_) {
        is_over_ = true;
        return std::nullopt;
    }
    const bool was_told = is_told_ && !is_logged_;
    warn_at_.reset();
    is_told_ = is_logged_ = is_over_ = false;
    if (is_given_up)
        return Message{
            {LogLevel::notice,
             fmt::format("the stop is given up{}{}: THE MOTOR MAY BE MOVING, it has not confirmed it",
                         look.operator_name.empty() ? "" : " by ", look.operator_name)},
            JournalEvent::stop_given_up};
    if (!was_told) return std::nullopt;
    return Message{{LogLevel::notice, "the motor has confirmed the stop now"}, JournalEvent::stop_confirmed};
}

void StopMessages::begin(const Look& look, base::Instant now) {
    warn_at_ = now + (has_answered_ ? kLongest : kFirstAnswer);
    command_before_ = look.last_command;
    is_logged_ = false;
}

/// A motor that is not heard confirms nothing.
bool StopMessages::is_given_up(const Look& look) const {
    constexpr auto kGiveUp = static_cast<std::uint32_t>(registers::gateway::Command::give_up_stop);
    return look.last_command == kGiveUp && (command_before_ != kGiveUp || !look.link_is_usable);
}

base::Instant StopMessages::next() const {
    if (!warn_at_) return base::kNever;
    if (is_over_) return {};
    return is_told_ ? base::kNever : *warn_at_;
}

}  // namespace nplc::boards
