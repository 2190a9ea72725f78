#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <utility>

namespace nplc::macreg {

/// The line's last exchange in bytes, and the meaning of it and of those before it.
class ExchangeLog {
  public:
    const std::string& sent() const { return sent_; }
    const std::string& received() const { return received_; }
    /// The oldest first.
    const std::deque<std::string>& lines() const { return lines_; }
    void add(std::string sent, std::string received, const std::string& line) {
        sent_ = std::move(sent);
        received_ = std::move(received);
        lines_.push_back(line);
        if (lines_.size() > kMostLines) lines_.pop_front();
    }

  private:
    static constexpr std::size_t kMostLines = 200;

    std::string sent_;
    std::string received_;
    std::deque<std::string> lines_;
};

}  // namespace nplc::macreg
