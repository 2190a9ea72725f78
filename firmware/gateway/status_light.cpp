#include "gateway/status_light.h"

namespace nplc::gateway {
namespace {

bool is_fault(SafeReason reason) {
    switch (reason) {
        case SafeReason::none:
        case SafeReason::not_started:
        case SafeReason::stop_command:
        case SafeReason::safe_command:
            return false;
        case SafeReason::link_down:
        case SafeReason::motor_stuck:
        case SafeReason::bad_table:
        case SafeReason::watchdog:
        case SafeReason::enable_lost:
        case SafeReason::no_lines:
        case SafeReason::no_store:
        case SafeReason::no_port:
        case SafeReason::no_proof:
        case SafeReason::bad_settings:
        case SafeReason::bad_run_mark:
            return true;
    }
    return true;
}

/// `count` flashes of 125 ms, 250 ms apart.
bool flashes(std::uint32_t count, std::uint32_t at) {
    return at < count * 250 && at % 250 < 125;
}

}  // namespace

bool status_light(RunState run_state, SafeReason reason, std::uint32_t milliseconds) {
    if (is_fault(reason)) return flashes(4, milliseconds % 2000);
    switch (run_state) {
        case RunState::stopped:
            return milliseconds % 1000 < 500;
        case RunState::waiting_for_motor:
            return flashes(2, milliseconds % 1000);
        case RunState::running:
            return true;
        case RunState::holding:
        case RunState::held:
            return milliseconds % 250 < 125;
    }
    return false;
}

std::uint32_t next_status_light(RunState run_state, SafeReason reason, std::uint32_t milliseconds) {
    constexpr std::uint32_t kBeat = 125;  // all flashes are multiples of it
    constexpr std::uint32_t kLongest = 2000;
    const bool now = status_light(run_state, reason, milliseconds);
    for (std::uint32_t in = kBeat - milliseconds % kBeat; in <= kLongest; in += kBeat) {
        if (status_light(run_state, reason, milliseconds + in) != now) return in;
    }
    return 0;
}

}  // namespace nplc::gateway
