#pragma once

#include <string>

#include "sim/mac_motor.h"

namespace nplc::sim {

/// A motor's parameter flash as a text file: a line `REGISTER = VALUE` for each memory cell that is not 0, in
/// decimal; `#` begins a comment. Functions answer what went wrong, in one line, or nothing.
std::string load_flash(const std::string& path, MacMotor& motor);
/// The file appears whole or stays as it was.
std::string save_flash(const std::string& path, const MacMotor& motor);

}  // namespace nplc::sim
