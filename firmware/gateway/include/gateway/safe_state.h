#pragma once

#include <cstdint>

#include "base/time.h"
#include "gateway/vocabulary.h"

namespace nplc::gateway {

enum class StartCause : std::uint8_t {
    power_up,
    watchdog,
    service,  ///< for maintenance: not enabled, whatever the settings say, until the next start
};

/// What allows the sequence to start, besides the enable input.
class StartPermission {
  public:
    explicit StartPermission(StartCause cause)
        : in_service_(cause == StartCause::service), starting_up_(cause == StartCause::power_up) {}

    bool allows_start() const { return !in_service_ && locked_by_ == SafeReason::none; }
    bool is_in_service() const { return in_service_; }
    void begin_service() { in_service_ = true; }
    /// The first table may start without a command.
    bool allows_autostart() const { return starting_up_; }
    void end_start_up() { starting_up_ = false; }

    void lock(SafeReason reason) { locked_by_ = reason; }
    /// False if the lock has another reason.
    bool unlock(SafeReason reason) {
        if (locked_by_ != reason) return false;
        locked_by_ = SafeReason::none;
        return true;
    }
    /// The reason of the lock, or `reason` if there is no lock.
    SafeReason shown(SafeReason reason) const { return locked_by_ == SafeReason::none ? reason : locked_by_; }

  private:
    bool in_service_;
    bool starting_up_;
    SafeReason locked_by_ = SafeReason::none;
};

/// The reason of the safe state, and since when it holds.
class SafeState {
  public:
    SafeReason reason() const { return reason_; }
    base::Instant since() const { return since_; }
    std::uint32_t since_uptime() const { return since_uptime_; }

    /// True if the reason has changed.
    bool enter(SafeReason reason, base::Instant now, std::uint32_t uptime) {
        if (reason_ == reason) return false;
        reason_ = reason;
        since_ = now;
        since_uptime_ = uptime;
        return true;
    }
    /// Replaces the reason of the present safe state, keeping its time.
    void set_reason(SafeReason reason) { reason_ = reason; }
    void leave() { reason_ = SafeReason::none; }

  private:
    SafeReason reason_ = SafeReason::not_started;
    std::uint32_t since_uptime_ = 0;
    base::Instant since_{};
};

}  // namespace nplc::gateway
