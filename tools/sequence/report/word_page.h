#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "diagnostics/reference.h"

namespace nplc::seqc {

/// A register of the motors that have it alike.
struct RegisterPage {
    std::string motors;  ///< "MAC50, MAC95, MAC140 and MAC141"
    std::string name;    ///< in their manual
    int number = 0;
    std::string title;
    std::string facts;  ///< Markdown
};

/// All that is known of a word of programs.
struct WordPage {
    std::string word;
    bool is_of_language = false;  ///< reserved or a command: the reference comes first
    std::vector<Paragraph> passages;
    std::vector<RegisterPage> registers;
    std::vector<std::string> values;  ///< a mode, a bit or a field: a line for each register that has it
    bool is_empty() const { return passages.empty() && registers.empty() && values.empty(); }
};

/// A word of the language, a command or its byte (63h), the name of a register, of a mode, a bit or a field;
/// in any case.
WordPage page_of_word(std::string_view written);

/// "; did you mean 'WITHIN'?", "; nearest are WITHIN and INPOS", or a reference for a word of scenarios;
/// empty if nothing is similar.
std::string nearest_words(std::string_view wanted);

}  // namespace nplc::seqc
