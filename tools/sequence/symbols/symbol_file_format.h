#pragma once

#include <string_view>

namespace nplc::seqc {

inline constexpr std::string_view kSymbolsFormat = "nanoplc-symbols";
inline constexpr unsigned kSymbolsVersion = 2;
/// Of a file without inverted inputs.
inline constexpr unsigned kPlainSymbolsVersion = 1;

}  // namespace nplc::seqc
