#pragma once

#include <string>
#include <string_view>

namespace nplc::sim::fmu {

/// The shared library that this program brings along for FMUs.
std::string_view library();

/// Where it belongs in an FMU: "binaries/x86_64-linux/nanoplc.so", of FMI 2.0 "binaries/linux64/nanoplc.so".
std::string library_path(int fmi);

}  // namespace nplc::sim::fmu
