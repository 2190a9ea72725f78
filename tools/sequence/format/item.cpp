#include "format/layout.h"

#include <algorithm>

namespace nplc::seqc::layout {
namespace {

constexpr std::uint32_t kTab = 4;
constexpr std::string_view kBlanks = " \t\r\f\v";

/// Tracks line ends and columns through the source.
class Place {
  public:
    explicit Place(std::string_view source) : source_(source) {}

    /// Advances to `offset`; returns the number of line ends passed.
    std::size_t go_to(std::size_t offset) {
        std::size_t breaks = 0;
        for (; at_ < offset; ++at_) {
            const char c = source_[at_];
            if (c == '\n') {
                ++breaks;
                column_ = 0;
            } else if (c == '\t') {
                column_ += kTab - column_ % kTab;
            } else {
                ++column_;
            }
        }
        return breaks;
    }
    std::uint32_t column() const { return column_; }

  private:
    std::string_view source_;
    std::size_t at_ = 0;
    std::uint32_t column_ = 0;
};

std::string_view without_blanks_behind(std::string_view text) {
    const std::size_t last = text.find_last_not_of(kBlanks);
    return text.substr(0, last == text.npos ? 0 : last + 1);
}

std::string without_returns(std::string_view text) {
    std::string result;
    for (char c : text) {
        if (c == '\n') result.resize(result.find_last_not_of('\r') + 1);
        result += c;
    }
    return result;
}

void add(Document& document, const Token& token, Place& place) {
    Item item;
    item.breaks = static_cast<std::uint8_t>(std::min<std::size_t>(2, place.go_to(token.span.offset)));
    item.column = place.column();
    item.text = token.text;
    item.token = token.kind;
    if (token.kind == TokenKind::comment && token.text.starts_with("//")) {
        item.kind = Item::Kind::line_comment;
        item.text = without_blanks_behind(token.text);
    } else if (token.kind == TokenKind::comment) {
        item.kind = Item::Kind::block_comment;
        if (token.text.find("\r\n") != token.text.npos)
            item.text = document.texts.emplace_back(without_returns(token.text));
    } else if (token.kind == TokenKind::identifier) {
        item.kind = Item::Kind::name;
    }
    place.go_to(std::size_t{token.span.offset} + token.span.length);
    document.items.push_back(item);
}

}  // namespace

Document document_of(std::string_view source, const std::vector<Token>& tokens,
                     const std::vector<Token>& comments) {
    Document document;
    document.items.reserve(tokens.size() + comments.size());
    Place place(source);
    auto comment = comments.begin();
    for (const Token& token : tokens) {
        for (; comment != comments.end() && comment->span.offset < token.span.offset; ++comment)
            add(document, *comment, place);
        if (token.kind != TokenKind::end) add(document, token, place);
    }
    for (; comment != comments.end(); ++comment) add(document, *comment, place);
    return document;
}

Tokens::Tokens(Document& document) : document_(document) {
    for (std::size_t i = 0; i < document.items.size(); ++i) {
        if (!document.items[i].is_comment()) places_.push_back(i);
    }
}

std::size_t width(std::string_view text) {
    const std::string_view last = text.substr(text.rfind('\n') + 1);
    return static_cast<std::size_t>(
        std::count_if(last.begin(), last.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace nplc::seqc::layout
