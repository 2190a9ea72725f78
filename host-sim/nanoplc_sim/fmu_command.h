#pragma once

#include <optional>
#include <string>

#include "registers/mac.h"

namespace nplc::sim {

/// The command line of `nanoplc-sim fmu`.
struct FmuCommand {
    std::string output;
    std::string program;                    ///< of the gateway; empty: the motor alone
    std::optional<std::string> symbols;     ///< as of `run`
    std::optional<registers::Model> motor;  ///< the program's own without it
    std::optional<std::string> plant;       ///< file
    int fmi = 3;
    std::optional<std::string> windows;  ///< file of the library for Windows
};

/// Writes the FMU, or throws InputError and writes nothing.
void write_fmu(const FmuCommand& command);

}  // namespace nplc::sim
