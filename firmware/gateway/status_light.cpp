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
        case SafeReason::bad_set_points:
        case SafeReason::bad_run_mark:
            return true;
    }
    return true;
}

constexpr std::uint32_t kBeat = 125;  // ms
constexpr std::uint32_t kBeats = 16;

/// One bit per beat over two seconds, the first beat in bit 0.
std::uint32_t beats(RunState run_state, SafeReason reason) {
    if (is_fault(reason)) return 0b0000'0000'0101'0101;
    switch (run_state) {
        case RunState::stopped:
            return 0b0000'1111'0000'1111;
        case RunState::waiting_for_motor:
            return 0b0000'0101'0000'0101;
        case RunState::running:
            return 0b1111'1111'1111'1111;
        case RunState::holding:
        case RunState::held:
            return 0b0101'0101'0101'0101;
    }
    return 0;
}

}  // namespace

bool status_light(RunState run_state, SafeReason reason, std::uint32_t milliseconds) {
    return (beats(run_state, reason) >> (milliseconds / kBeat % kBeats) & 1U) != 0;
}

std::uint32_t next_status_light(RunState run_state, SafeReason reason, std::uint32_t milliseconds) {
    const bool now = status_light(run_state, reason, milliseconds);
    for (std::uint32_t in = kBeat - milliseconds % kBeat; in <= kBeats * kBeat; in += kBeat) {
        if (status_light(run_state, reason, milliseconds + in) != now) return in;
    }
    return 0;
}

}  // namespace nplc::gateway
