#pragma once

#include <string_view>

namespace nplc::seqc {

/// A word of another language that people write here.
struct ForeignWord {
    std::string_view word;
    std::string_view help;  ///< what to write instead
    std::string_view end;   ///< the word that ends its block, if it has one
};

/// Null for words that mean nothing special; case does not matter.
const ForeignWord* foreign_word(std::string_view word);

}  // namespace nplc::seqc
