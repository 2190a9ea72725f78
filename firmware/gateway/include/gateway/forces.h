#pragma once

#include <cstdint>

#include "base/time.h"

namespace nplc::gateway {

/// Levels that a person puts in the place of others.
struct Forced {
    std::uint8_t mask = 0;
    std::uint8_t levels = 0;

    constexpr std::uint8_t over(std::uint8_t real) const {
        return static_cast<std::uint8_t>((real & ~unsigned{mask}) | (unsigned{levels} & mask));
    }
};

/// Forced inputs and outputs, and how long they still hold.
class Forces {
  public:
    const Forced& inputs() const { return inputs_; }
    const Forced& outputs() const { return outputs_; }
    bool any() const { return inputs_.mask != 0 || outputs_.mask != 0; }

    void set_inputs(const Forced& forced, base::Instant now) {
        inputs_ = forced;
        renewed_ = now;
    }
    void set_outputs(const Forced& forced, base::Instant now) {
        outputs_ = forced;
        renewed_ = now;
    }
    void renew(base::Instant now) { renewed_ = now; }
    void end() { inputs_ = outputs_ = {}; }

    /// Until all end unless renewed; 0 if nothing is forced.
    base::Microseconds left(base::Instant now, base::Microseconds time) const {
        if (!any() || now - renewed_ >= time) return {};
        return time - (now - renewed_);
    }

    base::Instant end(base::Microseconds time) const { return any() ? renewed_ + time : base::kNever; }

  private:
    Forced inputs_;
    Forced outputs_;
    base::Instant renewed_{};
};

}  // namespace nplc::gateway
