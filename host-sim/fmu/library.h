#pragma once

#include <string>
#include <string_view>

namespace nplc::sim::fmu {

/// The shared library for FMUs that is embedded in this program.
std::string_view library();

/// Its path in an FMU: "binaries/x86_64-linux/nanoplc.so", for FMI 2.0 "binaries/linux64/nanoplc.so".
std::string library_path(int fmi);

}  // namespace nplc::sim::fmu
