#pragma once

#include <cstdint>
#include <span>

#include "base/time.h"
#include "ports/clock.h"
#include "ports/digital_io.h"
#include "ports/serial.h"
#include "ports/storage.h"
#include "ports/watchdog.h"
#include "store/layout.h"
#include "update/receiver.h"

/// The gateway on a board without an operating system: start-up order, main loop, restart.
namespace nplc::bare_metal {

/// A board's ports, initialized except for lines and watchdog.
struct Parts {
    ports::Clock& clock;
    ports::DigitalInputs& inputs;
    ports::DigitalOutputs& outputs;
    ports::Watchdog& watchdog;
    ports::Storage& storage;
    ports::SerialPort* user_line;  ///< null: no user port
    ports::SerialPort& motor_line;
    ports::SerialPort* motor_mactalk_line;  ///< the motor's own MacTalk port; null: not wired
    const store::Area& table_area;
    const store::Area& settings_area;
    std::span<std::uint8_t> table;  ///< memory for the active table
    const store::Area* set_point_area =
        nullptr;               ///< null: none are stored, as in a build without NPLC_SET_POINTS
    bool for_service = false;  ///< only the user port is served, and nothing runs until the next start
};

/// The chip's interrupts must be enabled already.
[[noreturn]] void run(const Parts& parts);

// Provided by the board, beyond the ports.

void begin_lines(std::uint32_t user_baud, std::uint32_t motor_baud);
bool has_received();  ///< on any line
/// Starts the watchdog with this watchdog timeout.
void begin_watchdog(base::Milliseconds time);
void set_watchdog_time(base::Milliseconds time);
/// The watchdog has reset the chip since the last call.
bool take_watchdog_reset();
/// Only in a build with NPLC_UPDATE.
update::Receiver& firmware_receiver();

}  // namespace nplc::bare_metal
