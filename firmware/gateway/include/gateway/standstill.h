#pragma once

#include <cstdint>

#include "base/time.h"
#include "gateway/command_result.h"
#include "motor/motor.h"

namespace nplc::gateway {

/// Checks with the motor that it stands still. R: V_IST is 0 and P_IST, read twice at least 50 ms apart,
/// differs by one count at the most; V_IST alone is in whole counts per sample, which misses speeds up to 7
/// rpm.
class Standstill {
  public:
    explicit Standstill(motor::Motor& motor) : motor_(motor) {}

    void begin(base::Instant now);
    /// done, moving, or link_down: no answer within 1 s, in which a link may still come up.
    PendingResult poll(base::Instant now);
    /// Latest time of the next poll if the motor's driver has nothing new.
    base::Instant next_poll(base::Instant now) const;
    void drop() { motor_.drop_access(); }

  private:
    enum class Phase : std::uint8_t { first_position, speed, second_position };

    PendingResult take(std::uint32_t value, base::Instant now);
    std::uint8_t register_of_phase() const;
    bool is_word() const { return phase_ == Phase::speed && !motor_.longwords_only(); }

    motor::Motor& motor_;
    Phase phase_ = Phase::first_position;
    bool asked_ = false;
    std::uint32_t position_ = 0;
    base::Instant begun_{};
    base::Instant position_at_{};
};

}  // namespace nplc::gateway
