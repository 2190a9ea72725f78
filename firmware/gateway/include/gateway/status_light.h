#pragma once

#include <cstdint>

#include "gateway/vocabulary.h"

namespace nplc::gateway {

/// What an output that a lamp hangs on shows: on: the sequence runs. 1 Hz: stopped. 4 Hz: held, or about to
/// be. Two short flashes a second: started and waiting for the motor. Four short flashes in two seconds, then
/// dark: the outputs are safe although the sequence runs (the link is down), or the reason is a fault.
bool status_light(RunState run_state, SafeReason reason, std::uint32_t milliseconds);

/// In how many milliseconds it changes; 0: never, as things stand.
std::uint32_t next_status_light(RunState run_state, SafeReason reason, std::uint32_t milliseconds);

}  // namespace nplc::gateway
