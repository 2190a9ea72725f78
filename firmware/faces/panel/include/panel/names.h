#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "faces/points.h"

/// Of symbol files, as written by `seqc build`.
namespace nplc::panel {

/// The most lists and objects in each other, of symbol files and of requests too. What is deeper is not read.
inline constexpr std::size_t kDeepestJson = 16;

/// Whether `text` is the symbol file of the table with this CRC-32.
bool is_for_table(std::string_view text, std::uint32_t crc);

/// SCALE of the program; revolutions without one.
faces::Scaling scale_in(std::string_view text);
bool is_same(const faces::Scaling& a, const faces::Scaling& b);
/// `5 mm a revolution`
std::string in_words(const faces::Scaling& scaling);

}  // namespace nplc::panel
