#pragma once

namespace nplc::ports {

/// Resets the board unless fed in time. Only a finished scan feeds it.
class Watchdog {
  public:
    virtual void feed() = 0;

  protected:
    ~Watchdog() = default;
};

}  // namespace nplc::ports
