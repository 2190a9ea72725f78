#pragma once

#include <span>
#include <string_view>

namespace nplc::seqc {

/// Reserved words, which cannot be names.
bool is_reserved(std::string_view word);
std::span<const std::string_view> reserved_words();

/// Whether a text can be a name: letters, digits and underscores, and no word of the language.
bool is_name(std::string_view text);

/// Keywords that begin a construct above the level of a statement, or end a block.
bool is_boundary(std::string_view word);

}  // namespace nplc::seqc
