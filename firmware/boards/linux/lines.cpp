#include "lines.h"

#include <fmt/format.h>

#include <utility>

namespace nplc::boards {

namespace {

constexpr base::Milliseconds kBetweenTriesToOpen{250};

}  // namespace

std::string ReconnectingUart::open(const std::string& who, const hal_linux::UartSettings& settings) {
    who_ = who;
    path_ = settings.path;
    uart_.reset();  // the port is held exclusively
    uart_ = hal_linux::Uart::absent(settings);
    retry_at_ = base::kNever;
    problem_ = uart_->reopen();
    return problem_;
}

bool ReconnectingUart::look(Journal& journal, base::Instant now) {
    if (!uart_->gone()) return false;
    if (retry_at_ == base::kNever) {
        tell(journal, problem_.empty() ? path_ + " is gone; plug the adapter in again" : problem_);
        retry_at_ = now;
    }
    if (now < retry_at_) return false;
    retry_at_ = now + kBetweenTriesToOpen;
    const std::string before = std::exchange(problem_, uart_->reopen());
    if (problem_.empty()) {
        retry_at_ = base::kNever;
        journal.write(LogLevel::notice, who_ + ": " + path_ + " is back");
        return true;
    }
    if (!before.empty() && before != problem_) tell(journal, problem_);
    return false;
}

void ReconnectingUart::tell(Journal& journal, const std::string& problem) {
    journal.write(LogLevel::error, who_ + ": " + problem);
}

namespace {

using ports::CanState;

/// A controller in state warning or passive still takes part on the bus.
CanState without_degrees(CanState state) {
    return state == CanState::warning || state == CanState::passive ? CanState::active : state;
}

}  // namespace

void ReconnectingCan::open(const std::string& who, const hal_linux::CanSettings& settings) {
    who_ = who;
    interface_ = settings.interface;
    can_ = hal_linux::SocketCan::absent(settings);
    retry_at_ = base::kNever;
    problem_ = can_->reopen();
}

void ReconnectingCan::look(Journal& journal, base::Instant now) {
    tell_state(journal);
    tell_problem(journal);
    if (!can_->gone()) {
        retry_at_ = base::kNever;
        return;
    }
    if (retry_at_ != base::kNever && now < retry_at_) return;
    retry_at_ = now + kBetweenTriesToOpen;
    const std::string before = std::exchange(problem_, can_->reopen());
    if (problem_.empty()) return tell_state(journal);
    if (!before.empty() && before != problem_)
        journal.write(LogLevel::error, fmt::format("{}: {}", who_, problem_));
}

void ReconnectingCan::tell_problem(Journal& journal) {
    if (can_->state() != CanState::bus_off || can_->restart_problem().empty() ||
        can_->restart_problem() == told_problem_)
        return;
    told_problem_ = can_->restart_problem();
    journal.write(LogLevel::info, fmt::format("{}: {}", who_, told_problem_));
}

void ReconnectingCan::tell_state(Journal& journal) {
    if (can_->gone() != told_gone_) {
        told_gone_ = can_->gone();
        if (!told_gone_)
            journal.write(LogLevel::notice, fmt::format("{}: {} is back", who_, interface_));
        else
            journal.write(LogLevel::error,
                          fmt::format("{}: {}", who_,
                                      problem_.empty() ? interface_ + " is gone; plug the adapter in again"
                                                       : problem_));
        told_ = CanState::down;
    }
    const CanState state = without_degrees(can_->state());
    if (told_gone_ || state == told_) return;
    told_ = state;
    if (state == CanState::active) {
        journal.write(LogLevel::notice, fmt::format("{}: {} takes part in the bus", who_, interface_));
    } else if (state == CanState::bus_off) {
        journal.write(LogLevel::error,
                      fmt::format("{}: {} is off the bus; look at its bit rate, its wires and the 120 Ohm at "
                                  "both ends; it is restarted",
                                  who_, interface_));
    } else {
        journal.write(LogLevel::error, fmt::format("{}: {} is down; as root: ip link set {} up", who_,
                                                   interface_, interface_));
    }
}

}  // namespace nplc::boards
