#include "kept_uart.h"

#include <utility>

namespace nplc::boards {
namespace {

constexpr base::Milliseconds kBetweenUartTries{250};

}  // namespace

std::string KeptUart::open(const std::string& who, const hal_linux::UartSettings& settings) {
    who_ = who;
    path_ = settings.path;
    uart_.reset();  // the port is held exclusively
    uart_ = hal_linux::Uart::absent(settings);
    retry_at_ = base::kNever;
    problem_ = uart_->reopen();
    return problem_;
}

bool KeptUart::look(Journal& journal, base::Instant now) {
    if (!uart_->gone()) return false;
    if (retry_at_ == base::kNever) {
        tell(journal, problem_.empty() ? path_ + " is gone; plug the adapter in again" : problem_);
        retry_at_ = now;
    }
    if (now < retry_at_) return false;
    retry_at_ = now + kBetweenUartTries;
    const std::string before = std::exchange(problem_, uart_->reopen());
    if (problem_.empty()) {
        retry_at_ = base::kNever;
        journal.write(LogLevel::notice, who_ + ": " + path_ + " is back");
        return true;
    }
    if (!before.empty() && before != problem_) tell(journal, problem_);
    return false;
}

void KeptUart::tell(Journal& journal, const std::string& problem) {
    journal.write(LogLevel::error, who_ + ": " + problem);
}

}  // namespace nplc::boards
