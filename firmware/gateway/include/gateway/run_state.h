#pragma once

#include <cstdint>

namespace nplc::gateway {

/// The numbers are those of the user's port (REGISTERS.md).
enum class RunState : std::uint8_t {
    stopped = 0,  ///< no table, not started, or in the safe state after a reason that needs run()
    waiting_for_motor =
        1,  ///< started; the link is not up yet, or the motor has not yet taken the stop order
    running = 2,
    holding = 3,  ///< its last orders are being executed, then the motor is being stopped, to be held
    held = 4,     ///< between two scans, until run(), scan_once() or step_once()
};

/// Why the outputs have their safe values (and, where the line works, the motor was told to stop). The
/// numbers are those of the user's port.
enum class SafeReason : std::uint8_t {
    none = 0,
    not_started = 1,
    stop_command = 2,
    link_down = 3,    ///< ends when the link is up again and the sequence has sent "reset error"
    motor_stuck = 4,  ///< a scan waited longer than Settings::longest_wait
    bad_table = 5,
    watchdog = 6,
    enable_lost = 7,
    safe_command = 8,
    bad_settings = 9,   ///< the stored ones are damaged: nothing runs until settings are kept
    bad_run_mark = 10,  ///< what says that the sequence runs is damaged, missing, or cannot be written
    no_lines = 11,      ///< 11 to 13: the board lacks what the axis needs and tries to have it again
    no_store = 12,
    no_port = 13,  ///< the user's
};

}  // namespace nplc::gateway
