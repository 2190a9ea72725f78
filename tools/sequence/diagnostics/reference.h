#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nplc::seqc {

/// A paragraph, a row of a table or a rule of the grammar of LANGUAGE.md.
struct Paragraph {
    std::string_view section;  ///< "7. Timer and counter"
    std::string_view text;
};

/// The text, without the marks of a table's row that tells what a word means.
std::string shown(const Paragraph& passage);

/// The reference's passages about a word, what it means first; empty if it does not occur.
std::vector<Paragraph> passages_about(std::string_view word);

/// Words in capitals that it has, each once.
std::vector<std::string_view> reference_words();

}  // namespace nplc::seqc
