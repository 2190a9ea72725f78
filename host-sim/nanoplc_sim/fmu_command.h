#pragma once

#include <optional>
#include <string>

#include "registers/mac.h"

namespace nplc::sim {

/// The command line of `nanoplc-sim fmu`.
struct FmuCommand {
    std::string output;
    std::string program;                    ///< the gateway's; empty: the motor alone
    std::optional<std::string> symbols;     ///< as for `run`
    std::optional<registers::Model> motor;  ///< empty: the program's own
    std::optional<std::string> plant;       ///< file
    int fmi = 3;
    std::optional<std::string> windows;  ///< file of the library for Windows
};

/// Writes the FMU, or throws InputError and writes nothing.
void write_fmu(const FmuCommand& command);

}  // namespace nplc::sim
