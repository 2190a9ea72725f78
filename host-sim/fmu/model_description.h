#pragma once

#include <string>

#include "sim/fmu/fmu_file.h"

namespace nplc::sim::fmu {

/// modelDescription.xml in options.fmi's version.
std::string model_description(const FmuOptions& options);

}  // namespace nplc::sim::fmu
