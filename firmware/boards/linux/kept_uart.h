#pragma once

#include <memory>
#include <string>

#include "base/time.h"
#include "hal_linux/uart.h"
#include "journal.h"

namespace nplc::boards {

/// A serial port that is looked for again when its adapter was pulled out, or was not there at the start.
class KeptUart {
  public:
    /// Empty, or one line: then it is gone until look() finds it.
    std::string open(const std::string& who, const hal_linux::UartSettings& settings);
    hal_linux::Uart& uart() { return *uart_; }
    bool gone() const { return uart_->gone(); }
    /// True if it has come back, with another descriptor. Says so, and says when it has gone.
    bool look(Journal& journal, base::Instant now);
    /// When look() is wanted at the latest.
    base::Instant next_look() const { return retry_at_; }

  private:
    void tell(Journal& journal, const std::string& problem);

    std::string who_;
    std::string path_;
    std::string problem_;  ///< why it could not be opened the last time; empty: it was
    std::unique_ptr<hal_linux::Uart> uart_;
    base::Instant retry_at_ = base::kNever;
};

}  // namespace nplc::boards
