#pragma once

#include <cstdint>

#include "base/time.h"
#include "motor/stop_pace.h"
#include "protocol/flexmac.h"

namespace nplc::motor {

/// A stop for a motor that does not answer (001 §5.2): 7Fh and FFh twice each bring it into FlexMAC whatever
/// its toggle, MODE_REG := 0 twice, 7Eh three times bring it back. A pause of two characters before each part
/// ends what the motor may have taken for the beginning of another message. Never before the link has been
/// declared lost: a motor in step would be put out of it.
class BlindStop {
  public:
    /// The first one is sent at `from` at the earliest.
    void allow(base::Instant from) {
        if (!allowed_) due_ = from;
        allowed_ = true;
    }
    bool is_allowed() const { return allowed_; }
    /// A new stop was requested: the quick repetition begins again.
    void begin_anew() { pace_.begin_anew(); }

    /// A sequence of parts has been started and not finished.
    bool is_under_way() const { return part_ != 0; }
    bool is_due(base::Instant now) const { return allowed_ && now >= due_; }
    base::Instant due() const { return due_; }

    /// The next part, to be sent when the one before has left the transmitter; empty after the last one.
    /// `longword`: MODE_REG has 32 bits.
    protocol::flexmac::Encoded take_part(bool longword, base::Instant now);

  private:
    bool allowed_ = false;
    std::uint8_t part_ = 0;  ///< that is to be sent next
    StopPace pace_;
    base::Instant due_{};
};

}  // namespace nplc::motor
