#pragma once

#include <string_view>

namespace nplc::seqc {

/// A keyword of another language that users may write.
struct ForeignWord {
    std::string_view word;
    std::string_view help;  ///< the correct form in this language
    std::string_view end;   ///< the word that ends its block, if it has one
};

/// Null for ordinary words; case-insensitive.
const ForeignWord* foreign_word(std::string_view word);

}  // namespace nplc::seqc
