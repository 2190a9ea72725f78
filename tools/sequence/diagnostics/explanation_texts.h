#pragma once

#include <span>
#include <string_view>

namespace nplc::seqc {

/// The files diagnostics/*.txt, embedded by the build.
extern const std::span<const std::string_view> kExplanationTexts;

/// LANGUAGE.md, embedded likewise.
std::string_view language_reference();

}  // namespace nplc::seqc
