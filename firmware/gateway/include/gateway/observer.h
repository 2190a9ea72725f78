#pragma once

#include "base/time.h"
#include "sequencer/state.h"

namespace nplc::gateway {

/// Listener of the sequence: traces, tests, the user port. Called from Gateway::poll.
class Observer {
  public:
    /// An order of a true term was passed to the motor, in table order.
    virtual void ordered(base::Instant now, const sequencer::MotorOrder& order) = 0;

    /// A scan that was not skipped has finished. `before` and `image` are what its conditions saw.
    virtual void scanned(base::Instant now, const sequencer::State& before, sequencer::InputImage image,
                         const sequencer::State& after) = 0;

  protected:
    ~Observer() = default;
};

}  // namespace nplc::gateway
