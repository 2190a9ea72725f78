#include "syntax/lexer.h"

#include <fmt/format.h>

#include <utility>

#include "syntax/names.h"

namespace nplc::seqc {
namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_word(char c) {
    return is_letter(c) || is_digit(c);
}
bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
}
bool is_symbol(char c) {
    return std::string_view(":;,().=+-/").find(c) != std::string_view::npos;
}

class Lexer {
  public:
    Lexer(std::string_view source, Report& report, std::vector<Token>* comments)
        : source_(source), report_(report), comments_(comments) {}

    std::vector<Token> run() {
        if (source_.starts_with("\xEF\xBB\xBF")) at_ = 3;
        while (skip_blanks_and_comments(), at_ < source_.size()) {
            if (tokens_.size() == kMostTokens) {
                report_.add("E001", {static_cast<std::uint32_t>(at_), 1},
                            fmt::format("more than {} words and signs: this is no program", kMostTokens),
                            "name the program's text, a .seq file");
                tokens_.clear();
                break;
            }
            lex_token();
        }
        add(TokenKind::end, at_);
        return std::move(tokens_);
    }

  private:
    char peek(std::size_t ahead = 0) const {
        return at_ + ahead < source_.size() ? source_[at_ + ahead] : '\0';
    }

    Span span_from(std::size_t start) const {
        return {static_cast<std::uint32_t>(start), static_cast<std::uint32_t>(at_ - start)};
    }

    void add(TokenKind kind, std::size_t start) {
        tokens_.push_back({kind, source_.substr(start, at_ - start), span_from(start)});
    }

    void skip_blanks_and_comments() {
        while (at_ < source_.size()) {
            const std::size_t start = at_;
            if (is_blank(peek())) {
                ++at_;
            } else if (source_.substr(at_).starts_with("//")) {
                at_ = std::min(source_.find('\n', at_), source_.size());
                add_comment(start);
            } else if (source_.substr(at_).starts_with("(*")) {
                skip_block_comment();
                add_comment(start);
            } else {
                return;
            }
        }
    }

    void add_comment(std::size_t start) {
        if (comments_ == nullptr) return;
        comments_->push_back({TokenKind::comment, source_.substr(start, at_ - start), span_from(start)});
    }

    void skip_block_comment() {
        const std::size_t end = source_.find("*)", at_ + 2);
        if (end == std::string_view::npos) {
            report_.add("E002", {static_cast<std::uint32_t>(at_), 2}, "this comment is never closed",
                        "close it with *)");
            at_ = source_.size();
        } else {
            at_ = end + 2;
        }
    }

    void lex_token() {
        const std::size_t start = at_;
        if (is_letter(peek())) {
            lex_word(start);
        } else if (is_digit(peek())) {
            lex_number(start);
        } else if (peek() == '%' && is_letter(peek(1))) {
            ++at_;
            take_word_and_dots();
            add(TokenKind::direct, start);
        } else if (is_symbol(peek())) {
            at_ += source_.substr(at_).starts_with(":=") ? 2U : 1U;
            add(TokenKind::symbol, start);
        } else {
            lex_unknown(start);
        }
    }

    void take_word_and_dots() {
        while (is_word(peek()) || (peek() == '.' && is_digit(peek(1)))) ++at_;
    }

    void lex_word(std::size_t start) {
        while (is_word(peek())) ++at_;
        const std::string_view word = source_.substr(start, at_ - start);
        if (peek() == '#' && (same_name(word, "T") || same_name(word, "TIME"))) {
            ++at_;
            take_word_and_dots();
            add(TokenKind::time, start);
        } else {
            add(TokenKind::identifier, start);
        }
    }

    void lex_number(std::size_t start) {
        while (is_digit(peek()) || peek() == '_') ++at_;
        if (peek() == '#') {
            ++at_;
            while (is_word(peek())) ++at_;
            add(TokenKind::based, start);
            return;
        }
        if (peek() == '.' && is_digit(peek(1))) {
            ++at_;
            while (is_digit(peek()) || peek() == '_') ++at_;  // the parser refuses the latter
        }
        add(TokenKind::number, start);
    }

    /// Other languages' signs for AND, OR and NOT are taken as meant, so that nothing else is reported.
    bool lex_foreign_operator(std::size_t start) {
        constexpr std::pair<char, std::string_view> kOperators[] = {{'&', "AND"}, {'|', "OR"}, {'!', "NOT"}};
        for (const auto& [sign, word] : kOperators) {
            if (peek() != sign) continue;
            while (peek() == sign && at_ < start + 2) ++at_;
            report_.add("E001", span_from(start),
                        fmt::format("'{}' means nothing here", source_.substr(start, at_ - start)),
                        fmt::format("write {}", word));
            tokens_.push_back({TokenKind::identifier, word, span_from(start)});
            return true;
        }
        return false;
    }

    /// 'words', closed in the same line.
    bool lex_text(std::size_t start) {
        const std::size_t end = source_.find_first_of("'\n", at_ + 1);
        if (peek() != '\'' || end == std::string_view::npos || source_[end] == '\n') return false;
        at_ = end + 1;
        add(TokenKind::text, start);
        return true;
    }

    void lex_unknown(std::size_t start) {
        if (lex_text(start) || lex_foreign_operator(start)) return;
        while (at_ < source_.size() && !is_blank(peek()) && !is_word(peek()) && !is_symbol(peek()) &&
               !(peek() == '%' && is_letter(peek(1)))) {
            ++at_;
        }
        const std::string_view text = source_.substr(start, at_ - start);
        const bool shown = text.size() <= 4 && text.find_first_not_of("\"'!#$&*<>?@[]\\^`{|}~%") == text.npos;
        report_.add("E001", span_from(start),
                    shown ? fmt::format("'{}' means nothing here", text)
                          : "these characters mean nothing in a program",
                    "names are letters, digits and _; comments are // ... or (* ... *)");
    }

    std::string_view source_;
    Report& report_;
    std::vector<Token>* comments_;
    std::size_t at_ = 0;
    std::vector<Token> tokens_;
};

}  // namespace

std::vector<Token> tokens_of(std::string_view source, Report& report, std::vector<Token>* comments) {
    return Lexer(source, report, comments).run();
}

}  // namespace nplc::seqc
