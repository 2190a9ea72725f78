#pragma once

#include <span>
#include <string_view>

namespace nplc::seqc {

/// The files diagnostics/*.txt, put into the program by the build.
extern const std::span<const std::string_view> kExplanationTexts;

/// LANGUAGE.md, likewise.
extern const std::string_view kReference;

}  // namespace nplc::seqc
