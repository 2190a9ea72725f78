#pragma once

#include <string>

#include "sim/midi_module.h"

namespace nplc::sim {

/// What a module keeps without power, as a text file of lines `NAME = VALUE` in decimal. Answer what went
/// wrong, in one line, or nothing.
std::string load_eeprom(const std::string& path, MidiModule& module);
/// The file appears whole or stays as it was.
std::string save_eeprom(const std::string& path, const MidiModule& module);

}  // namespace nplc::sim
