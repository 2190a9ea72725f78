#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "language/token.h"

namespace nplc::seqc::layout {

/// Effect of a line on the indentation.
enum class Role : std::uint8_t {
    plain,
    opener,       ///< STEP, IF ..: following lines are one level deeper
    middle,       ///< ELSIF, ELSE
    closer,       ///< END_STEP, END_IF ..
    declaration,  ///< of a variable
};

/// A token or a comment. First the properties from the source, then those of the layout.
struct Item {
    enum class Kind : std::uint8_t { keyword, name, other, line_comment, block_comment };

    std::string_view text;
    Kind kind = Kind::other;
    TokenKind token = TokenKind::comment;
    std::uint8_t breaks = 0;   ///< line ends before it; 2 for more
    std::uint32_t column = 0;  ///< from 0; a tab advances to the next multiple of 4

    std::uint8_t blanks = 1;  ///< blanks before it, unless it begins a line
    std::uint8_t level = 0;
    bool starts_line = false;
    Role role = Role::plain;

    bool is_comment() const { return kind == Kind::line_comment || kind == Kind::block_comment; }
    bool is_keyword(std::string_view word) const { return kind == Kind::keyword && text == word; }
    bool is_symbol(std::string_view symbol) const { return token == TokenKind::symbol && text == symbol; }
};

/// A program as items. Also stores the texts of items with changed spelling.
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

/// Tokens (the end token may be among them) and comments of `source` in their order. Line comments lose
/// trailing blanks, and comments the CRs before line ends.
Document document_of(std::string_view source, const std::vector<Token>& tokens,
                     const std::vector<Token>& comments);

/// A document's tokens without comments. Beyond the last one every query returns false.
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
    /// Index of the token among all items.
    std::size_t place(std::size_t i) const { return places_[i]; }

  private:
    Document& document_;
    std::vector<std::size_t> places_;
};

/// Characters (UTF-8) after the last line end of `text`.
std::size_t width(std::string_view text);

/// A line of the result. Either part may be empty, not both.
struct Line {
    std::vector<Item*> code;            ///< with the comments between its words
    std::vector<const Item*> comments;  ///< after the code
    std::size_t indent = 0;
    Role role = Role::plain;
    bool blank_before = false;
    bool is_own_comment = false;     ///< `code` is a comment between statements
    bool continues = false;          ///< continues the statement of the previous line
    bool continues_comment = false;  ///< continues the comment after the previous line
};

/// Including its indentation; 0 without code.
std::size_t code_width(const Line& line);

/// The lines of a shaped document, with comments in their places.
std::vector<Line> lines_of(Document& document);

/// Breaks lines over 120 columns before AND, OR, XOR and WHEN and behind commas; a TERM stays whole.
void wrap(std::vector<Line>& lines);

/// Inserts and removes blank lines: none at the edges of a block, one around blocks of several lines.
void space_out(std::vector<Line>& lines);

/// Pads the declarations of each block so that AT, and the type or value, are aligned in columns.
void align_declarations(std::vector<Line>& lines);

/// The lines as text; comments after code in column 41, or further right if needed by their run.
std::string print(const std::vector<Line>& lines);

inline constexpr std::size_t kIndent = 4;
inline constexpr std::size_t kWidestOneLiner = 100;
inline constexpr std::size_t kWidest = 120;  ///< longer lines are broken

/// Decides which tokens begin a line, their level, and the blanks before the others. A block that was written
/// on one line stays on one if it has a single statement and is not too wide.
void shape(Document& document);

/// Marks the language's words and normalizes case: keywords, commands, registers and addresses as in the
/// manual and the README, names as in their declaration. Unknown words are unchanged.
void spell(Document& document);

/// Formats the text of a program. Not checked for validity: any token sequence is formatted somehow.
std::string lay_out(std::string_view source, std::vector<Token> tokens, std::vector<Token> comments);

/// Why `text` cannot replace `source`: a word or a comment differs, or formatting it again would change it.
/// Empty if it can.
std::string fault_between(std::string_view source, std::string_view text);

}  // namespace nplc::seqc::layout
