#pragma once

#include <string_view>

namespace nplc::seqc {

inline constexpr std::string_view kSymbolsFormat = "nanoplc-symbols";
inline constexpr unsigned kSymbolsVersion = 1;

}  // namespace nplc::seqc
