#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "diagnostics/report.h"
#include "language/token.h"
#include "seqc/sources.h"

namespace nplc::seqc {

inline constexpr std::size_t kLongestSource = 16U << 20;
inline constexpr std::size_t kMostTokens = 4'000'000;

/// The tokens of `source`, with an end token; at most kMostTokens, more is an error. They point into
/// `source`. Comments are added to `comments`, if given: with their delimiters, a line comment without its
/// line end.
std::vector<Token> tokens_of(std::string_view source, Report& report, std::vector<Token>* comments = nullptr);
/// The same for one file of a program; spans are positions in its whole text.
std::vector<Token> tokens_of(const Sources& sources, const SourceFile& file, Report& report);

}  // namespace nplc::seqc
