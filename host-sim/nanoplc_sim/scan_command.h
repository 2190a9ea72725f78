#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nplc::sim {

/// One scan's input image, and the time from its commands to the next scan.
struct StimulusRow {
    std::uint32_t dt_ms = 0;
    std::uint8_t image = 0;  ///< HW_INP: inputs, INPOS, ERROR
    bool operator==(const StimulusRow&) const = default;
};

/// Another preset of timer or counter in some terms of the table: the value of a set-point.
struct StimulusPreset {
    std::uint16_t value = 0;
    std::vector<std::size_t> terms;  ///< by number, from 0
    bool operator==(const StimulusPreset&) const = default;
};

/// The lines `# preset 10000 in term 5, 9: Soak := 10000 ms` before the header, each for a set-point; what
/// stands behind the colon is for readers. Throws InputError with file and line.
std::vector<StimulusPreset> parse_presets(std::string_view text, const std::string& file);

/// CSV with the header `dt_ms,inputs,inpos,error` and plain decimal numbers; CR LF and blank lines at the end
/// are accepted, and the lines of parse_presets() are skipped. Throws InputError with file and line.
std::vector<StimulusRow> parse_stimulus(std::string_view text, const std::string& file);

/// `nanoplc-sim scan`: the engine alone, one scan a row. CSV with the header
/// `scan,step,timer,counter,outputs,fastmac,flexmac`; scans count from 1; all values as they stand after step
/// 4 of 001 §6.1.9. `bytes` must be one that Table::load takes.
std::string scan_csv(std::span<const std::uint8_t> bytes, const std::vector<StimulusRow>& rows);

/// Prints nothing before all input is checked. Throws InputError.
void run_scan(const std::string& table_file, const std::string& stimulus_file);

}  // namespace nplc::sim
