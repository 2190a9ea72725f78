#include "kept_uart.h"

namespace nplc::boards {
namespace {

constexpr base::Milliseconds kBetweenTries{250};

}  // namespace

std::string KeptUart::open(const std::string& who, const hal_linux::UartSettings& settings) {
    who_ = who;
    path_ = settings.path;
    uart_.reset();  // the port is held exclusively
    retry_at_ = base::kNever;
    hal_linux::Uart::Opened opened = hal_linux::Uart::open(settings);
    uart_ = std::move(opened.uart);
    return opened.error;
}

bool KeptUart::look(Journal& journal, base::Instant now) {
    if (!uart_->gone()) return false;
    if (retry_at_ == base::kNever) {
        journal.write(LogLevel::error, who_ + ": " + path_ + " is gone; plug the adapter in again");
        retry_at_ = now;
    }
    if (now < retry_at_) return false;
    retry_at_ = now + kBetweenTries;
    if (!uart_->reopen().empty()) return false;
    retry_at_ = base::kNever;
    journal.write(LogLevel::notice, who_ + ": " + path_ + " is back");
    return true;
}

}  // namespace nplc::boards
