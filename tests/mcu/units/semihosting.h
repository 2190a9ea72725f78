#pragma once

namespace nplc::mcu_units {

/// To the host, by way of its debugger or emulator.
void print(const char* text);
/// Ends the emulator, with exit code 0 if all is well and 1 if not.
[[noreturn]] void exit(bool well);

}  // namespace nplc::mcu_units

namespace mcu_units = nplc::mcu_units;
