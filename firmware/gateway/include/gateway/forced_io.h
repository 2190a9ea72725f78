#pragma once

#include <cstdint>

#include "base/time.h"
#include "registers/vocabulary.h"

namespace nplc::gateway {

using registers::gateway::Force;

/// Forced inputs and outputs, with their timeout.
class ForcedIo {
  public:
    const Force& inputs() const { return inputs_; }
    const Force& outputs() const { return outputs_; }
    bool any() const { return inputs_.mask != 0 || outputs_.mask != 0; }

    void set_inputs(const Force& force, base::Instant now) {
        inputs_ = force;
        renewed_ = now;
    }
    void set_outputs(const Force& force, base::Instant now) {
        outputs_ = force;
        renewed_ = now;
    }
    void renew(base::Instant now) { renewed_ = now; }
    void end() { inputs_ = outputs_ = {}; }

    /// Time until all forces end unless renewed; 0 if nothing is forced.
    base::Microseconds left(base::Instant now, base::Microseconds time) const {
        if (!any() || now - renewed_ >= time) return {};
        return time - (now - renewed_);
    }

    base::Instant end(base::Microseconds time) const { return any() ? renewed_ + time : base::kNever; }

  private:
    Force inputs_;
    Force outputs_;
    base::Instant renewed_{};
};

}  // namespace nplc::gateway
