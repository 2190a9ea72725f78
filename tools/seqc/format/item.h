#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "syntax/token.h"

namespace nplc::seqc::layout {

/// What a line does to those around it.
enum class Role : std::uint8_t {
    plain,
    opener,       ///< STEP, IF ..: those after it are one level deeper
    middle,       ///< ELSIF, ELSE
    closer,       ///< END_STEP, END_IF ..
    declaration,  ///< of a variable
};

/// A token or a comment. What the source says of it comes first, then what the layout says.
struct Item {
    enum class Kind : std::uint8_t { keyword, name, other, line_comment, block_comment };

    std::string_view text;
    Kind kind = Kind::other;
    TokenKind token = TokenKind::comment;
    std::uint8_t breaks = 0;   ///< line ends before it; 2 for more
    std::uint32_t column = 0;  ///< from 0, a tab counts up to the next multiple of 4

    std::uint8_t blanks = 1;  ///< before it, unless it begins a line
    std::uint8_t level = 0;
    bool starts_line = false;
    Role role = Role::plain;

    bool is_comment() const { return kind == Kind::line_comment || kind == Kind::block_comment; }
    bool is_keyword(std::string_view word) const { return kind == Kind::keyword && text == word; }
    bool is_symbol(std::string_view symbol) const { return token == TokenKind::symbol && text == symbol; }
};

/// A program as items. The texts of some are spelled anew and kept here.
struct Document {
    std::vector<Item> items;
    std::deque<std::string> texts;

    Document() = default;
    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;
    Document(Document&&) = default;
    Document& operator=(Document&&) = default;
    ~Document() = default;
};

/// Tokens (the end token may be among them) and comments of `source` in its order. Comments lose the blanks
/// at the end of a line comment and the CRs before a line end.
Document document_of(std::string_view source, const std::vector<Token>& tokens,
                     const std::vector<Token>& comments);

/// A document's tokens without the comments between them. Past the last one there is nothing and every
/// question is answered with no.
class Tokens {
  public:
    explicit Tokens(Document& document);

    std::size_t size() const { return places_.size(); }
    Item& operator[](std::size_t i) { return document_.items[places_[i]]; }
    const Item& operator[](std::size_t i) const { return document_.items[places_[i]]; }
    bool is_keyword(std::size_t i, std::string_view word) const {
        return i < size() && (*this)[i].is_keyword(word);
    }
    bool is_symbol(std::size_t i, std::string_view symbol) const {
        return i < size() && (*this)[i].is_symbol(symbol);
    }
    /// Where the token stands among all items.
    std::size_t place(std::size_t i) const { return places_[i]; }

  private:
    Document& document_;
    std::vector<std::size_t> places_;
};

/// Characters (UTF-8) behind the last line end of `text`.
std::size_t width(std::string_view text);

}  // namespace nplc::seqc::layout
