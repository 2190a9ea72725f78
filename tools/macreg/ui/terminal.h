#pragma once

#include <string>

#include "macreg/ui_model.h"

namespace nplc::macreg {

/// Owns the terminal while the full screen is shown; restored by the destructor, and before a crash ends the
/// program. One at a time.
class Terminal {
  public:
    /// Throws std::runtime_error if there is no terminal, or an unknown one.
    Terminal();
    ~Terminal();
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    /// Waits no longer than this for a key.
    static KeyPress key(int milliseconds);
    /// True until SIGINT, SIGTERM, SIGHUP or SIGQUIT is received.
    static bool goes_on();
    bool has_colours() const { return colours_; }
    /// Braille and line characters can be shown.
    bool is_utf8() const { return utf8_; }

  private:
    bool colours_ = false;
    bool utf8_ = false;
    void* screen_ = nullptr;
};

/// Smaller screens show a request for a larger one.
inline constexpr int kLeastRows = 16;
inline constexpr int kLeastColumns = 60;

/// Draws the whole screen. `title` is the port and the motor.
void draw(UiModel& model, const Terminal& terminal, const std::string& title);

}  // namespace nplc::macreg
