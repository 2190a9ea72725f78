#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "faces/points.h"

/// Of symbol files, as written by `seqc build`.
namespace nplc::panel {

/// The most lists and objects in each other, of symbol files and of requests too. What is deeper is not read.
inline constexpr std::size_t kDeepestJson = 16;

/// Whether `text` is the symbol file of the table with this CRC-32.
bool is_for_table(std::string_view text, std::uint32_t crc);

/// SCALE of the program; revolutions without one.
faces::Scaling scale_in(std::string_view text);
/// Names of signals and steps; of another form than seqc's they are left out.
struct SignalNames {
    std::vector<std::string> inputs{};   ///< from IN0 on; empty: without a name
    std::vector<std::string> outputs{};  ///< from OUT0 on
    std::map<std::uint8_t, std::string> steps{};
    std::uint8_t inverted_inputs = 0;  ///< a bit for each input whose name holds while its terminal is off
};
SignalNames signals_in(std::string_view text);
bool is_same(const faces::Scaling& a, const faces::Scaling& b);
/// `5 mm a revolution`
std::string in_words(const faces::Scaling& scaling);

}  // namespace nplc::panel
