#pragma once

#include <cstdint>

#include "base/time.h"
#include "protocol/flexmac.h"

namespace nplc::motor {

/// A stop for a motor that does not answer (001 §5.2): 7Fh and FFh twice each switch it to FlexMAC whatever
/// its toggle, then MODE_REG := 0 twice, then 7Eh three times switch it back. A pause of two characters
/// before each part ends a partial message that the motor may have received. Sent every 50 ms for 1 s, then
/// every 500 ms. Only after the link has been declared lost, since it would desynchronize a working link.
class BlindStop {
  public:
    /// The first one is sent at `from` at the earliest.
    void allow(base::Instant from) {
        if (!allowed_) due_ = from;
        allowed_ = true;
    }
    bool is_allowed() const { return allowed_; }
    /// For a new stop request: restarts the fast repetition.
    void begin_anew() { count_ = 0; }

    /// A sequence of parts has been started and not finished.
    bool is_under_way() const { return part_ != 0; }
    bool is_due(base::Instant now) const { return allowed_ && now >= due_; }
    base::Instant due() const { return due_; }

    /// The next part, to be sent when the one before has left the transmitter; empty after the last one.
    /// `longword`: MODE_REG has 32 bits.
    protocol::flexmac::Encoded take_part(bool longword, base::Instant now);

  private:
    bool allowed_ = false;
    std::uint8_t part_ = 0;   ///< the next one to send
    std::uint8_t count_ = 0;  ///< repetitions since the stop request
    base::Instant due_{};
};

}  // namespace nplc::motor
