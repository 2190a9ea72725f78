#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/text.h"

namespace nplc::sim {

/// What is wrong with the line at hand.
struct LineMistake {
    std::string message;
};

struct Token {
    enum class Kind : std::uint8_t { word, number, text, symbol, end } kind = Kind::end;
    std::string_view text;  ///< of a quoted text: what stands between the quotes
    double number = 0;
    std::size_t begin = 0;  ///< in the line
    std::size_t end = 0;
};

/// One line, without its comment (`#` or `//`). The last token is of kind `end`. Throws LineMistake.
std::vector<Token> tokens_of(std::string_view line);

/// Reads tokens one after the other; words are compared without regard to case.
class Reader {
  public:
    explicit Reader(std::string_view line) : line_(line), tokens_(tokens_of(line)) {}

    const Token& peek(std::size_t ahead = 0) const;
    const Token& next();
    bool at_end() const { return peek().kind == Token::Kind::end; }
    bool is(std::string_view word_or_symbol, std::size_t ahead = 0) const;
    bool take(std::string_view word_or_symbol);
    /// Throws with `what_to_write` unless it is there.
    void want(std::string_view word_or_symbol, std::string_view what_to_write);
    /// What was found, and what to write instead.
    [[noreturn]] void fail(std::string_view what_to_write) const;

    std::size_t mark() const { return position_; }
    bool was_first(std::string_view word) const { return same_name(tokens_.front().text, word); }
    /// The source from the token at `mark` to the one read last.
    std::string source_since(std::size_t mark) const;

    double number(std::string_view what_to_write);
    Time duration(std::string_view what_to_write);
    double percent(std::string_view what_to_write);
    bool starts_duration() const;

  private:
    std::string_view line_;
    std::vector<Token> tokens_;
    std::size_t position_ = 0;
};

}  // namespace nplc::sim
