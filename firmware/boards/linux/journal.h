#pragma once

#include <string>

namespace nplc::boards {

/// As the journal counts them.
enum class LogLevel : int { error = 3, warning = 4, notice = 5, info = 6, debug = 7 };

/// Lines for a person on standard error. Where that is the journal each begins with its level, <3>, which the
/// journal takes off.
class Journal {
  public:
    explicit Journal(LogLevel most);
    void set_most(LogLevel most) { most_ = most; }
    void write(LogLevel level, const std::string& text);
    bool writes(LogLevel level) const { return level <= most_; }

  private:
    LogLevel most_;
    bool with_levels_;
};

}  // namespace nplc::boards
