#pragma once

#include <optional>
#include <string>

#include "registers/mac.h"
#include "sim/serial_line.h"
#include "sim/text.h"

namespace nplc::sim {

/// The command line of `nanoplc-sim run`.
struct RunOptions {
    std::string program;                 ///< empty: the table that the flash holds, or none
    std::optional<std::string> symbols;  ///< without it, F.sym beside a table if it fits
    std::optional<std::string> scenario;
    std::optional<std::string> csv;
    std::optional<std::string> vcd;
    std::optional<std::string> mactalk;  ///< endpoint of the user's port
    std::optional<std::string> flash;    ///< file that keeps the gateway's flash
    std::optional<Time> length;
    std::optional<registers::Model> motor;  ///< the program's own without it
    bool realtime = false;
    bool quiet = false;
    bool rapid = false;
    bool old_register_codes = false;
    bool keep_motor = false;
    Time debounce = std::chrono::milliseconds{3};
    std::uint32_t baud = 19'200;
    std::uint64_t seed = 1;
    LineFaults faults;
};

}  // namespace nplc::sim
