#include "syntax/lexer.h"

#include <fmt/format.h>

#include <algorithm>
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
    return std::string_view(":;,().=+-/<>").find(c) != std::string_view::npos;
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
            } else if (peek() == '#' || source_.substr(at_).starts_with("/*")) {
                skip_foreign_comment();
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

    void skip_foreign_comment() {
        const std::size_t start = at_;
        const bool is_line = peek() == '#';
        const std::size_t end = source_.find(is_line ? "\n" : "*/", at_);
        report_.add("E001", {static_cast<std::uint32_t>(start), is_line ? 1U : 2U},
                    fmt::format("'{}' begins no comment here", is_line ? "#" : "/*"),
                    "comments are // ... to the end of the line, or (* ... *)");
        at_ = end == std::string_view::npos ? source_.size() : end + (is_line ? 0U : 2U);
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
        if (is_letter(peek()) || at_foreign_letter()) {
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
        bool foreign = false;
        while (is_word(peek()) || at_foreign_letter()) {
            foreign = foreign || at_foreign_letter();
            at_ += at_foreign_letter() ? 2U : 1U;
        }
        const std::string_view word = source_.substr(start, at_ - start);
        if (foreign && std::find(refused_.begin(), refused_.end(), word) == refused_.end()) {
            refused_.push_back(word);
            report_.add("E001", span_from(start),
                        fmt::format("'{}' has a letter that a name cannot have", word.substr(0, 60)),
                        spelt_plainly(word));
        }
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

    /// Latin, Greek and Cyrillic letters of two bytes of UTF-8, but for the signs for times and divided.
    bool at_foreign_letter() const {
        const auto first = static_cast<unsigned char>(peek());
        const auto second = static_cast<unsigned char>(peek(1));
        const bool letter = (first >= 0xC3 && first <= 0xC9) || (first >= 0xCD && first <= 0xD4);
        return letter && second >= 0x80 && second < 0xC0 &&
               !(first == 0xC3 && (second == 0x97 || second == 0xB7));
    }

    static std::string spelt_plainly(std::string_view word) {
        constexpr std::pair<std::string_view, std::string_view> kPlain[] = {
            {"\u00e4", "ae"}, {"\u00f6", "oe"}, {"\u00fc", "ue"}, {"\u00c4", "Ae"}, {"\u00d6", "Oe"},
            {"\u00dc", "Ue"}, {"\u00df", "ss"}, {"\u00e9", "e"},  {"\u00e8", "e"},  {"\u00e0", "a"},
            {"\u00e5", "aa"}, {"\u00f8", "oe"}, {"\u00e6", "ae"}, {"\u00e7", "c"},  {"\u00f1", "n"},
        };
        std::string plain(word);
        for (const auto& [letter, spelling] : kPlain) {
            for (std::size_t at = plain.find(letter); at != plain.npos; at = plain.find(letter))
                plain.replace(at, letter.size(), spelling);
        }
        const bool done = std::all_of(plain.begin(), plain.end(), is_word);
        return done ? fmt::format("write {}, or letters a to z, digits and _", plain)
                    : "names are letters a to z, digits and _";
    }

    /// "Ready": the word is taken as meant.
    bool lex_quoted(std::size_t start) {
        if (peek() != '"') return false;
        std::size_t end = at_ + 1;
        while (end < source_.size() && is_word(source_[end])) ++end;
        if (end == at_ + 1 || end == source_.size() || source_[end] != '"' || is_digit(peek(1))) return false;
        const std::string_view word = source_.substr(at_ + 1, end - at_ - 1);
        at_ = end + 1;
        report_.add("E001", span_from(start), "names stand without quotes", fmt::format("write {}", word));
        tokens_.push_back({TokenKind::identifier, word, span_from(start)});
        return true;
    }

    void lex_unknown(std::size_t start) {
        if (lex_text(start) || lex_foreign_operator(start) || lex_quoted(start)) return;
        if (source_.substr(at_).starts_with("\u00b0")) {
            at_ += 2;
            report_.add("E001", span_from(start), "this sign is no unit",
                        "write deg, and SCALE 1 rev = 360 deg; at the top");
            return;
        }
        if (peek() == '{' || peek() == '}') {
            if (!braces_refused_)
                report_.add("E001", {static_cast<std::uint32_t>(at_), 1}, "there are no braces here",
                            "a block ends with a word: IF .. THEN .. END_IF, STEP Name: .. END_STEP");
            braces_refused_ = true;
            ++at_;
            return;
        }
        if (peek() == '%') {
            ++at_;
            report_.add("E001", span_from(start), "'%' says not of what",
                        "write %peak or %nominal in one word");
            return;
        }
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
    bool braces_refused_ = false;
    std::vector<std::string_view> refused_;  ///< words with foreign letters
};

}  // namespace

std::vector<Token> tokens_of(std::string_view source, Report& report, std::vector<Token>* comments) {
    return Lexer(source, report, comments).run();
}

}  // namespace nplc::seqc
