#include "language/lexer.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <unordered_set>
#include <utility>

#include "language/characters.h"
#include "language/names.h"

namespace nplc::seqc {
namespace {

class Lexer {
  public:
    Lexer(std::string_view source, Report& report, std::vector<Token>* comments)
        : source_(source), report_(report), comments_(comments) {}

    std::vector<Token> run() {
        if (source_.starts_with("\xEF\xBB\xBF")) at_ = 3;
        while (skip_blanks_and_comments(), at_ < source_.size()) {
            if (skip_foreign_blank()) continue;
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

    const char* help_of_hash() const {
        const auto goes_on = [&](std::string_view word) { return source_.substr(at_ + 1).starts_with(word); };
        if (goes_on("include")) return "write INCLUDE 'wiring.seqi';";
        if (goes_on("define")) return "write CONST Pitch := 10 mm;";
        return "comments are // ... to the end of the line, or (* ... *)";
    }

    void skip_foreign_comment() {
        const std::size_t start = at_;
        const bool is_line = peek() == '#';
        const std::size_t end = source_.find(is_line ? "\n" : "*/", at_);
        report_.add("E001", {static_cast<std::uint32_t>(start), is_line ? 1U : 2U},
                    fmt::format("'{}' begins no comment here", is_line ? "#" : "/*"),
                    is_line ? help_of_hash() : "comments are // ... to the end of the line, or (* ... *)");
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
            at_ += source_.substr(at_).starts_with(":=") || source_.substr(at_).starts_with("..") ? 2U : 1U;
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
        while (is_word(peek()) || at_foreign_letter() || invisible_here() != 0) {
            foreign = foreign || !is_word(peek());
            at_ += at_foreign_letter() ? 2U : std::max<std::size_t>(invisible_here(), 1);
        }
        const std::string_view word = source_.substr(start, at_ - start);
        if (foreign && refused_.insert(word).second) {
            const bool is_hidden = hides_something(word);
            report_.add("E001", span_from(start),
                        is_hidden
                            ? "an invisible character stands in this word"
                            : fmt::format("'{}' has a letter that a name cannot have", word.substr(0, 60)),
                        is_hidden ? "delete the word and type it again" : spelt_plainly(word));
        }
        if (peek() == '#' && (same_name(word, "T") || same_name(word, "TIME"))) {
            ++at_;
            take_word_and_dots();
            add(TokenKind::time, start);
        } else if (peek() != '#' || !lex_typed_value(start, word)) {
            add(TokenKind::identifier, start);
        }
    }

    /// LTIME#500ms, INT#3: the value is accepted as intended.
    bool lex_typed_value(std::size_t start, std::string_view type) {
        if (!is_digit(peek(1))) return false;
        ++at_;
        const std::size_t value = at_;
        const bool is_time = same_name(type, "LTIME") || same_name(type, "LT") || same_name(type, "S5T") ||
                             same_name(type, "S5TIME");
        if (is_time) {
            take_word_and_dots();
            add(TokenKind::time, start);
        } else {
            lex_number(value);
        }
        const std::string_view written = source_.substr(value, at_ - value);
        report_.add("E001", span_from(start),
                    fmt::format("there are no values of the type {}", type.substr(0, 20)),
                    fmt::format("write {}{}", is_time ? "T#" : "", written.substr(0, 40)));
        return true;
    }

    static bool hides_something(std::string_view word) {
        return std::any_of(kInvisible.begin(), kInvisible.end(),
                           [&](std::string_view sign) { return word.find(sign) != word.npos; });
    }

    /// Length of the invisible character here, 0 if there is none.
    std::size_t invisible_here() const {
        if (static_cast<unsigned char>(peek()) < 0x80) return 0;
        const auto found = std::find_if(kInvisible.begin(), kInvisible.end(), [&](std::string_view sign) {
            return source_.substr(at_).starts_with(sign);
        });
        return found == kInvisible.end() ? 0 : found->size();
    }

    void lex_number(std::size_t start) {
        while (is_digit(peek()) || peek() == '_') ++at_;
        if (peek() == '#') {
            ++at_;
            while (is_word(peek())) ++at_;
            add(TokenKind::based, start);
            return;
        }
        if (peek() == '\'' && is_digit(peek(1))) return lex_grouped_number(start);
        if (peek() == '.' && is_digit(peek(1))) {
            ++at_;
            while (is_digit(peek()) || peek() == '_') ++at_;  // the parser rejects the latter
        }
        if (!lex_number_of_c(start)) add(TokenKind::number, start);
    }

    /// 0x10, 8e1, 80.0f: reported once, then handled as the number in front.
    bool lex_number_of_c(std::size_t start) {
        const std::string_view number = source_.substr(start, at_ - start);
        const auto is_sign = [&](std::string_view signs, std::size_t ahead) {
            return peek(ahead) != '\0' && signs.find(peek(ahead)) != signs.npos;
        };
        const bool is_hex = number == "0" && is_sign("xX", 0) && is_word(peek(1));
        const bool has_exponent =
            is_sign("eE", 0) && (is_digit(peek(1)) || (is_sign("+-", 1) && is_digit(peek(2))));
        const bool has_type = is_sign("fF", 0) && !is_word(peek(1));
        if (!is_hex && !has_exponent && !has_type) return false;
        ++at_;
        if (has_exponent && !is_digit(peek())) ++at_;
        while (is_word(peek())) ++at_;
        const std::string_view written = source_.substr(start, std::min<std::size_t>(at_ - start, 40));
        const std::string help = is_hex         ? hexadecimal(written.substr(2))
                                 : has_exponent ? written_out(written)
                                                : fmt::format("a number has no type: write {}", number);
        report_.add("E003", span_from(start), fmt::format("'{}' is not a value", written), help);
        tokens_.push_back({TokenKind::number, number, span_from(start)});
        return true;
    }

    static std::string hexadecimal(std::string_view digits) {
        const bool is_sound = std::all_of(digits.begin(), digits.end(), [](char c) {
            return c == '_' || is_digit(c) ||
                   std::string_view("abcdefABCDEF").find(c) != std::string_view::npos;
        });
        if (!is_sound) return "the digits of a hexadecimal number are 0 to 9 and A to F, as in 16#1F";
        return fmt::format("write 16#{}", digits);
    }

    static std::string written_out(std::string_view written) {
        double value = 0;
        const auto [end, error] = std::from_chars(written.data(), written.data() + written.size(), value);
        const bool is_read = error == std::errc() && end == written.data() + written.size();
        if (!is_read || value >= 1e10 || (value != 0 && value < 1e-4))
            return "a number has no exponent: write it out";
        std::string digits = fmt::format("{:.8f}", value);
        digits.erase(digits.find_last_not_of('0') + 1);
        if (digits.back() == '.') digits.pop_back();
        return fmt::format("a number has no exponent: write {}", digits);
    }

    /// 15'000
    void lex_grouped_number(std::size_t start) {
        std::size_t last = at_;
        while (peek() == '\'' && is_digit(peek(1))) {
            last = ++at_;
            while (is_digit(peek())) ++at_;
        }
        std::string written(source_.substr(start, at_ - start));
        std::replace(written.begin(), written.end(), '\'', '_');
        report_.add("E001", span_from(start), "digits are grouped with _ or not at all", "write " + written);
        tokens_.push_back({TokenKind::number, source_.substr(last, at_ - last), span_from(start)});
    }

    /// Other languages' operators for AND, OR and NOT are accepted as intended, so that there are no further
    /// errors.
    bool lex_foreign_operator(std::size_t start) {
        constexpr std::pair<std::string_view, std::string_view> kOperators[] = {
            {"&&", "AND"},    {"&", "AND"},      {"||", "OR"},     {"|", "OR"},
            {"!!", "NOT"},    {"!", "NOT"},      {"~", "NOT"},     {"\u2227", "AND"},
            {"\u2228", "OR"}, {"\u00ac", "NOT"}, {"\u2192", ":="}, {"\u21d2", ":="}};
        for (const auto& [sign, word] : kOperators) {
            if (!source_.substr(at_).starts_with(sign)) continue;
            at_ += sign.size();
            report_.add("E001", span_from(start), fmt::format("'{}' means nothing here", sign),
                        fmt::format("write {}", word));
            tokens_.push_back({is_letter(word.front()) ? TokenKind::identifier : TokenKind::symbol, word,
                               span_from(start)});
            return true;
        }
        return false;
    }

    /// 'words', closed in the same line.
    bool lex_text(std::size_t start) {
        if (peek() != '\'') return false;
        const std::size_t end = source_.find_first_of("'\n", at_ + 1);
        if (end == std::string_view::npos || source_[end] == '\n') return lex_open_text(start, end);
        at_ = end + 1;
        add(TokenKind::text, start);
        return true;
    }

    /// INCLUDE 'wiring.seqi;
    bool lex_open_text(std::size_t start, std::size_t line_end) {
        if (!takes_text() || source_.find_first_of(";\n", start) == start + 1) return false;
        at_ = std::min({source_.find(';', at_), line_end, source_.size()});
        while (is_blank(source_[at_ - 1])) --at_;
        report_.add("E001", span_from(start), "this text does not end in its line",
                    fmt::format("write {}'", source_.substr(start, std::min<std::size_t>(at_ - start, 60))));
        add(TokenKind::text, start);
        return true;
    }

    /// After INCLUDE and BECAUSE.
    bool takes_text() const {
        return !tokens_.empty() &&
               (same_name(tokens_.back().text, "INCLUDE") || same_name(tokens_.back().text, "BECAUSE"));
    }

    /// INCLUDE "wiring.seqi";
    bool lex_double_quoted_text(std::size_t start) {
        if (peek() != '"' || !takes_text()) return false;
        const std::size_t end = source_.find_first_of("\"\n", at_ + 1);
        if (end == std::string_view::npos || source_[end] == '\n') return false;
        at_ = end + 1;
        report_.add("E001", span_from(start), "quotes are ' on both sides",
                    fmt::format("write '{}'", source_.substr(start + 1, end - start - 1).substr(0, 60)));
        add(TokenKind::text, start);
        return true;
    }

    /// Two-byte UTF-8 letters, Latin, Greek and Cyrillic, and the accents that stand behind their letter
    /// (U+0300 to U+036F), except the signs for multiplication and division.
    bool at_foreign_letter() const {
        const auto first = static_cast<unsigned char>(peek());
        const auto second = static_cast<unsigned char>(peek(1));
        const bool letter = (first >= 0xC3 && first <= 0xC9) || (first >= 0xCC && first <= 0xD4);
        return letter && second >= 0x80 && second < 0xC0 &&
               !(first == 0xC3 && (second == 0x97 || second == 0xB7));
    }

    /// "Ready": the word is accepted as intended.
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

    /// No-break and other blanks in copied text; reported once.
    bool skip_foreign_blank() {
        for (const std::string_view blank :
             {"\u00a0", "\u2002", "\u2003", "\u2009", "\u200b", "\u202f", "\u2060", "\ufeff"}) {
            if (!source_.substr(at_).starts_with(blank)) continue;
            const std::size_t start = at_;
            at_ += blank.size();
            if (!std::exchange(blanks_refused_, true))
                report_.add("E001", span_from(start), "this is another blank than the one of the space bar",
                            "type it again: text from documents and web pages has such blanks");
            return true;
        }
        return false;
    }

    /// Characters that resemble one of the language's own, accepted as intended.
    bool lex_lookalike(std::size_t start) {
        struct Lookalike {
            std::string_view sign;
            std::string_view meant;
            bool is_told;  ///< otherwise the parser reports more
        };
        static constexpr Lookalike kSigns[] = {
            {"\u2013", "-", true},  {"\u2014", "-", true},  {"\u2212", "-", true}, {"\u2265", ">", false},
            {"\u2264", "<", false}, {"\u2260", "<", false}, {"\u201a", ",", true}, {"\uff1b", ";", true},
            {"\uff0c", ",", true},  {"\uff1a", ":", true},  {"\uff08", "(", true}, {"\uff09", ")", true},
            {"\uff1d", "=", true}};
        for (const auto& [sign, meant, is_told] : kSigns) {
            if (!source_.substr(at_).starts_with(sign)) continue;
            at_ += sign.size();
            if (is_told)
                report_.add("E001", span_from(start),
                            fmt::format("'{}' is another sign than '{}'", sign, meant),
                            fmt::format("type it anew: {}", meant));
            tokens_.push_back({TokenKind::symbol, meant, span_from(start)});
            return true;
        }
        return false;
    }

    /// Typographic quotes.
    bool lex_typeset_text(std::size_t start) {
        constexpr std::pair<std::string_view, std::string_view> kQuotes[] = {
            {"\u201c", "\u201d"}, {"\u201e", "\u201c"}, {"\u2018", "\u2019"}, {"\u00ab", "\u00bb"}};
        for (const auto& [open, close] : kQuotes) {
            if (!source_.substr(at_).starts_with(open)) continue;
            const std::string_view rest = source_.substr(at_, kLongestText);
            const std::size_t end = rest.find(close, open.size());
            if (end == rest.npos || end > rest.find('\n')) continue;
            at_ += end + close.size();
            report_.add("E001", span_from(start), "quotes are ' on both sides",
                        fmt::format("write '{}'", rest.substr(open.size(), end - open.size())));
            add(TokenKind::text, start);
            return true;
        }
        return false;
    }

    /// 80 \u00b5m: the unit is ignored.
    bool lex_micro(std::size_t start) {
        if (!source_.substr(at_).starts_with("\u00b5") && !source_.substr(at_).starts_with("\u03bc"))
            return false;
        at_ += 2;
        while (is_word(peek())) ++at_;
        report_.add("E001", span_from(start),
                    fmt::format("'{}' is no unit here", source_.substr(start, at_ - start)),
                    "write it in mm, ms or what SCALE names: 80 \u00b5m are 0.08 mm");
        return true;
    }

    /// m/s^2: the exponent follows the unit.
    bool lex_exponent(std::size_t start) {
        if (peek() != '^' || !is_digit(peek(1)) || tokens_.empty()) return false;
        at_ += 2;
        Token& unit = tokens_.back();
        report_.add("E001", span_from(start), "'^' means nothing here",
                    fmt::format("write {}{}", unit.text, source_[at_ - 1]));
        if (same_name(unit.text, "s") && source_[at_ - 1] == '2') unit.text = "s2";
        return true;
    }

    /// A brace is handled as the corresponding keyword of this language.
    void lex_brace(std::size_t start) {
        if (!std::exchange(braces_refused_, true))
            report_.add("E001", {static_cast<std::uint32_t>(start), 1}, "there are no braces here",
                        "a block ends with a word: IF .. THEN .. END_IF, STEP Name: .. END_STEP");
        const bool opens = peek() == '{';
        ++at_;
        if (opens) return open_brace(start);
        if (braces_.empty()) return;
        const std::string_view end = braces_.back();
        braces_.pop_back();
        skip_blanks_and_comments();
        const std::string_view rest = source_.substr(at_);
        const bool goes_on = rest.size() >= 4 &&
                             (same_name(rest.substr(0, 4), "ELSE") || same_name(rest.substr(0, 4), "ELSI"));
        if (!end.empty() && !(end == "END_IF" && goes_on))
            tokens_.push_back({TokenKind::identifier, end, {static_cast<std::uint32_t>(start), 1}});
    }

    /// Limit of words between IF or STEP and its brace, and of characters in a quoted text, so that the lexer
    /// runs in linear time.
    static constexpr std::size_t kLongestHead = 200;
    static constexpr std::size_t kLongestText = 1000;

    void open_brace(std::size_t start) {
        const Span span{static_cast<std::uint32_t>(start), 1};
        std::size_t looked_at = 0;
        for (auto token = tokens_.rbegin(); token != tokens_.rend() && ++looked_at < kLongestHead; ++token) {
            if (same_name(token->text, "IF") || same_name(token->text, "ELSIF")) {
                tokens_.push_back({TokenKind::identifier, "THEN", span});
                return braces_.push_back("END_IF");
            }
            if (same_name(token->text, "ELSE")) return braces_.push_back("END_IF");
            if (same_name(token->text, "STEP")) {
                if (tokens_.back().text != ":") tokens_.push_back({TokenKind::symbol, ":", span});
                return braces_.push_back("END_STEP");
            }
            if (token->text == ";" || same_name(token->text, "THEN")) break;
        }
        braces_.push_back("");
    }

    void lex_unknown(std::size_t start) {
        if (lex_text(start) || lex_foreign_operator(start) || lex_double_quoted_text(start) ||
            lex_quoted(start) || lex_lookalike(start) || lex_typeset_text(start) || lex_micro(start) ||
            lex_exponent(start))
            return;
        if (source_.substr(at_).starts_with("\u00b0")) {
            at_ += 2;
            report_.add("E001", span_from(start), "this sign is no unit",
                        "write deg, and SCALE 1 rev = 360 deg; at the top");
            return;
        }
        if (peek() == '{' || peek() == '}') return lex_brace(start);
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
    bool blanks_refused_ = false;
    std::vector<std::string_view> braces_;          ///< open ones: the end keyword of each
    std::unordered_set<std::string_view> refused_;  ///< words with foreign letters
};

}  // namespace

std::vector<Token> tokens_of(std::string_view source, Report& report, std::vector<Token>* comments) {
    return Lexer(source, report, comments).run();
}

}  // namespace nplc::seqc
