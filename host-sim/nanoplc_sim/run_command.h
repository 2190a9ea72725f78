#pragma once

#include <csignal>
#include <optional>
#include <string>
#include <vector>

#include "registers/family.h"
#include "sim/serial_line.h"
#include "sim/text.h"

namespace nplc::sim {

/// The command line of `nanoplc-sim run`.
struct RunOptions {
    std::string program;                 ///< empty: the table that the flash holds, or none
    std::optional<std::string> symbols;  ///< without it, F.sym beside a table if it fits
    std::optional<std::string> scenario;
    std::vector<std::string> inputs;   ///< names of those that are on from the beginning
    std::optional<std::string> plant;  ///< file
    std::optional<std::string> csv;
    std::optional<std::string> vcd;
    std::optional<std::string> junit;
    std::optional<std::string> mactalk;  ///< endpoint of the user's port
    std::optional<std::string> panel;    ///< ADDRESS:PORT of the browser panel
    std::optional<std::string> modbus;   ///< where a Modbus TCP server listens
    std::optional<std::string> metrics;  ///< where metrics are served
    std::optional<std::string> mqtt;     ///< HOST:PORT of a broker
    std::optional<std::string> flash;    ///< file that keeps the gateway's flash
    std::optional<Time> length;
    std::optional<registers::Model> motor;  ///< the program's own without it
    /// Of another family than JVL, in the place of the program's.
    const registers::DriveModel* drive = nullptr;
    std::optional<bool> can;  ///< to `drive`; else its serial line
    bool realtime = false;
    bool quiet = false;
    bool rapid = false;
    bool old_register_codes = false;
    bool keep_motor = false;
    bool is_new = false;
    Time debounce = std::chrono::milliseconds{3};
    std::optional<std::uint32_t> baud;  ///< 19200 of a JVL motor, else as the drive comes
    std::uint64_t seed = 1;
    LineFaults faults;

    std::uint32_t jvl_baud() const { return baud.value_or(19'200); }
};

/// Where the symbols of a program go for a plot of its trace. Empty for none: the trace is no ordinary file,
/// or the program's own symbol file has that name.
std::string symbols_beside_trace(const RunOptions& options);

/// `nanoplc-sim run`. Answers the exit code: 0, or 1 if an expectation failed. `interrupted` becomes other
/// than 0 when the user wants the run to end: it then ends in good order. Throws InputError, FileError,
/// EndlessRules.
int run(const RunOptions& options, const volatile std::sig_atomic_t& interrupted);

}  // namespace nplc::sim
