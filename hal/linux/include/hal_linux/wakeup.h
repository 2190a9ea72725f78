#pragma once

namespace nplc::hal_linux {

/// Wakes a thread that sleeps in poll() or an EventLoop: the descriptor is readable from ring() to drain().
class Wakeup {
  public:
    /// descriptor() is negative if the system has none left.
    Wakeup();
    ~Wakeup();
    Wakeup(const Wakeup&) = delete;
    Wakeup& operator=(const Wakeup&) = delete;

    /// Callable from any thread; neither blocks nor fails.
    void ring() const;
    void drain() const;
    int descriptor() const { return descriptor_; }

  private:
    int descriptor_;
};

}  // namespace nplc::hal_linux
