#pragma once

#include <cstdint>
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

/// CSV with the header `dt_ms,inputs,inpos,error` and plain decimal numbers; CR LF and blank lines at the end
/// are taken too. Throws InputError with file and line.
std::vector<StimulusRow> parse_stimulus(std::string_view text, const std::string& file);

}  // namespace nplc::sim
