#pragma once

#include <cstdint>

#include "gateway/vocabulary.h"

namespace nplc::gateway {

/// State of the status lamp. On: the sequence runs. 1 Hz: stopped. 4 Hz: held, or about to be. Two short
/// flashes a second: started and waiting for the motor. Four short flashes in two seconds, then dark: the
/// outputs are safe although the sequence runs (the link is down), or the reason is a fault.
bool status_light(RunState run_state, SafeReason reason, std::uint32_t milliseconds);

/// Milliseconds until it changes; 0: it does not change in this state.
std::uint32_t next_status_light(RunState run_state, SafeReason reason, std::uint32_t milliseconds);

}  // namespace nplc::gateway
