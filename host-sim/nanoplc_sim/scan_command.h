#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "stimulus.h"

namespace nplc::sim {

/// `nanoplc-sim scan`: the engine alone, one scan a row. CSV with the header
/// `scan,step,timer,counter,outputs,fastmac,flexmac`; scans count from 1; all values as they stand after step
/// 4 of 001 §6.1.9. `bytes` must be one that Table::load takes.
std::string scan_csv(std::span<const std::uint8_t> bytes, const std::vector<StimulusRow>& rows);

/// Prints nothing before everything is known to be good. Throws InputError.
void run_scan(const std::string& table_file, const std::string& stimulus_file);

}  // namespace nplc::sim
