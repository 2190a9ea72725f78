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
    std::string program;                 ///< empty: the table in the flash, or none
    std::optional<std::string> symbols;  ///< empty: F.sym next to a table, if it fits
    std::optional<std::string> scenario;
    std::vector<std::string> inputs;   ///< names of the inputs that are on at the start
    std::optional<std::string> plant;  ///< file
    std::optional<std::string> csv;
    std::optional<std::string> vcd;
    std::optional<std::string> junit;
    std::optional<std::string> mactalk;  ///< endpoint of the user's port
    std::optional<std::string> panel;    ///< ADDRESS:PORT of the browser panel
    std::optional<std::string> modbus;   ///< address of the Modbus TCP server
    std::optional<std::string> metrics;  ///< address of the metrics server
    std::optional<std::string> mqtt;     ///< HOST:PORT of a broker
    std::optional<std::string> flash;    ///< file with the gateway's flash
    std::optional<Time> length;
    std::optional<registers::Model> motor;  ///< a JVL motor; empty, and no `drive`: the program's own
    /// A drive of another family than JVL.
    const registers::DriveModel* drive = nullptr;
    std::optional<bool> can;  ///< for `drive`: CAN; else its serial line
    bool realtime = false;
    bool quiet = false;
    bool rapid = false;
    bool old_register_codes = false;
    bool keep_motor = false;
    bool is_new = false;
    Time debounce = std::chrono::milliseconds{3};
    std::optional<std::uint32_t> baud;  ///< 19200 for a JVL motor, else the drive's default
    std::uint64_t seed = 1;
    LineFaults faults;

    std::uint32_t jvl_baud() const { return baud.value_or(19'200); }
};

/// Where the symbols of a program are written for a plot of its trace. Empty for none: the trace is no
/// ordinary file, or the program's own symbol file has that name.
std::string symbols_beside_trace(const RunOptions& options);

/// `nanoplc-sim run`. Returns the exit code: 0, or 1 if an expectation failed. A nonzero `interrupted` ends
/// the run in order. Throws InputError, FileError, EndlessRules.
int run(const RunOptions& options, const volatile std::sig_atomic_t& interrupted);

}  // namespace nplc::sim
