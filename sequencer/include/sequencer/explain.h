#pragma once

#include "sequencer/state.h"

namespace nplc::sequencer {

/// Why a term is or is not true, seen from outside the scan: costs nothing while nobody asks.
struct Verdict {
    bool other_step = false;
    bool timer_running = false;     ///< the term wants timer = 0
    bool counter_not_zero = false;  ///< the term wants counter = 0
    InputImage differing = 0;       ///< bits of HW_INP that are not as wanted
    bool fires() const { return !other_step && !timer_running && !counter_not_zero && differing == 0; }
    bool operator==(const Verdict&) const = default;
};

/// `state` and `image` as they stood when the scan began.
Verdict explain(TermView term, const State& state, InputImage image);

}  // namespace nplc::sequencer
