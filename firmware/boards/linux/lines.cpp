#include "lines.h"

#include <fmt/format.h>

#include <utility>

namespace nplc::boards {

namespace {

constexpr base::Milliseconds kBetweenTriesToOpen{250};

}  // namespace

std::string ReconnectingUart::open(const hal_linux::UartSettings& settings, JournalFields lost) {
    path_ = settings.path;
    lost_ = std::move(lost);
    uart_.reset();  // the port is held exclusively
    uart_ = hal_linux::Uart::absent(settings);
    retry_at_ = base::kNever;
    problem_ = uart_->reopen();
    return problem_;
}

bool ReconnectingUart::look(AxisJournal& journal, base::Instant now) {
    const auto tell = [&](const std::string& problem) {
        journal.write(LogLevel::error, JournalEvent::port_gone, problem, lost_);
    };
    if (!uart_->gone()) return false;
    if (retry_at_ == base::kNever) {
        tell(problem_.empty() ? path_ + " is gone; plug the adapter in again" : problem_);
        retry_at_ = now;
    }
    if (now < retry_at_) return false;
    retry_at_ = now + kBetweenTriesToOpen;
    const std::string before = std::exchange(problem_, uart_->reopen());
    if (problem_.empty()) {
        retry_at_ = base::kNever;
        journal.write(LogLevel::notice, JournalEvent::port_back, path_ + " is back");
        return true;
    }
    if (!before.empty() && before != problem_) tell(problem_);
    return false;
}

namespace {

using ports::CanState;

/// A controller in state warning or passive still takes part on the bus.
CanState without_degrees(CanState state) {
    return state == CanState::warning || state == CanState::passive ? CanState::active : state;
}

}  // namespace

void ReconnectingCan::open(const hal_linux::CanSettings& settings, JournalFields lost) {
    lost_ = std::move(lost);
    interface_ = settings.interface;
    can_ = hal_linux::SocketCan::absent(settings);
    retry_at_ = base::kNever;
    problem_ = can_->reopen();
}

void ReconnectingCan::look(AxisJournal& journal, base::Instant now) {
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
        journal.write(LogLevel::error, JournalEvent::port_gone, problem_, lost_);
}

void ReconnectingCan::tell_problem(AxisJournal& journal) {
    if (can_->state() != CanState::bus_off || can_->restart_problem().empty() ||
        can_->restart_problem() == told_problem_)
        return;
    told_problem_ = can_->restart_problem();
    journal.write(LogLevel::info, JournalEvent::bus_state, told_problem_);
}

void ReconnectingCan::tell_presence(AxisJournal& journal) {
    if (can_->gone() == told_gone_) return;
    told_gone_ = can_->gone();
    told_ = CanState::down;
    if (!told_gone_) return journal.write(LogLevel::notice, JournalEvent::port_back, interface_ + " is back");
    journal.write(LogLevel::error, JournalEvent::port_gone,
                  problem_.empty() ? interface_ + " is gone; plug the adapter in again" : problem_, lost_);
}

void ReconnectingCan::tell_state(AxisJournal& journal) {
    tell_presence(journal);
    const CanState state = without_degrees(can_->state());
    if (told_gone_ || state == told_) return;
    told_ = state;
    if (state == CanState::active)
        return journal.write(LogLevel::notice, JournalEvent::bus_state,
                             interface_ + " takes part in the bus");
    const std::string text =
        state == CanState::bus_off
            ? " is off the bus; look at its bit rate, its wires and the 120 Ohm at both ends; it is restarted"
            : fmt::format(" is down; as root: ip link set {} up", interface_);
    journal.write(LogLevel::error, JournalEvent::bus_state, interface_ + text, lost_);
}

}  // namespace nplc::boards
