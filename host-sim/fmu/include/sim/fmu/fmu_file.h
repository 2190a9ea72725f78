#pragma once

#include <string>
#include <string_view>

#include "sim/fmu/setup.h"
#include "sim/snapshot.h"

namespace nplc::sim::fmu {

/// Name of the libraries in an FMU.
inline constexpr std::string_view kModelIdentifier = "nanoplc";

struct FmuOptions {
    Setup setup;
    Names names;              ///< the program's
    std::string model_name;   ///< as the importer shows it
    int fmi = 3;              ///< 3: FMI 3.0; 2: FMI 2.0
    std::string windows_dll;  ///< bytes of the library for Windows; empty: for this system only
};

/// The bytes of the FMU, the same for the same options. Throws BadMachine.
std::string fmu_file(const FmuOptions& options);

}  // namespace nplc::sim::fmu
