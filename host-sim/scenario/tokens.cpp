#include "parser.h"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <charconv>

namespace nplc::sim {
namespace {

constexpr std::array<std::string_view, 14> kSymbols{":=", "<=", ">=", "<>", "+-", "=", "<",
                                                    ">",  "(",  ")",  ",",  "%",  "-", "/"};

bool is_word_start(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}

bool is_word(char c) {
    return is_word_start(c) || std::isdigit(static_cast<unsigned char>(c)) != 0;
}

bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

std::size_t length_of_digits(std::string_view text) {
    std::size_t length = 0;
    while (length < text.size() &&
           (is_digit(text[length]) ||
            (text[length] == '.' && length + 1 < text.size() && is_digit(text[length + 1])))) {
        ++length;
    }
    return length;
}

/// 16#1F
std::size_t length_of_hex(std::string_view text) {
    if (!text.starts_with("16#")) return 0;
    std::size_t length = 3;
    while (length < text.size() && std::isxdigit(static_cast<unsigned char>(text[length])) != 0) ++length;
    return length > 3 ? length : 0;
}

Token number_at(std::string_view rest, std::size_t begin) {
    Token token{.kind = Token::Kind::number, .text = {}, .number = 0, .begin = begin, .end = begin};
    if (const std::size_t hex = length_of_hex(rest); hex != 0) {
        std::uint32_t value = 0;
        const auto [stop, error] = std::from_chars(rest.data() + 3, rest.data() + hex, value, 16);
        if (error != std::errc{}) throw LineMistake{"this hexadecimal number does not fit in 32 bits", begin};
        token.text = rest.substr(0, hex);
        token.number = value;
    } else {
        token.text = rest.substr(0, length_of_digits(rest));
        const auto value = parse_decimal(token.text);
        if (!value)
            throw LineMistake{
                fmt::format("\"{}\" is not a number; write digits such as 250 or 1.5", token.text), begin};
        token.number = *value;
    }
    const std::size_t comma = token.text.size();
    if (comma + 1 < rest.size() && rest[comma] == ',' && is_digit(rest[comma + 1])) {
        std::size_t digits = comma + 1;
        while (digits < rest.size() && is_digit(rest[digits])) ++digits;
        throw LineMistake{fmt::format("a number has a decimal point; write {}.{}", token.text,
                                      rest.substr(comma + 1, digits - comma - 1)),
                          begin};
    }
    token.end = begin + token.text.size();
    return token;
}

Token text_at(std::string_view rest, std::size_t begin) {
    const auto close = rest.find('"', 1);
    if (close == std::string_view::npos) throw LineMistake{"the text is not closed; end it with \"", begin};
    return {.kind = Token::Kind::text,
            .text = rest.substr(1, close - 1),
            .begin = begin,
            .end = begin + close + 1};
}

Token word_at(std::string_view rest, std::size_t begin) {
    std::size_t length = 1;
    while (length < rest.size() && is_word(rest[length])) ++length;
    return {.kind = Token::Kind::word, .text = rest.substr(0, length), .begin = begin, .end = begin + length};
}

Token symbol_at(std::string_view rest, std::size_t begin) {
    if (rest.starts_with("==")) throw LineMistake{"\"==\" is not known here; write = to compare", begin};
    if (rest.front() == '&') throw LineMistake{"\"&\" is not known here; write and", begin};
    if (rest.front() == '|') throw LineMistake{"\"|\" is not known here; write or", begin};
    if (rest.starts_with("\xC2\xB1")) throw LineMistake{"write +- for plus or minus", begin};
    if (rest.starts_with("!=")) throw LineMistake{"\"!=\" is not known here; write <> for unequal", begin};
    for (const std::string_view symbol : kSymbols) {
        if (!rest.starts_with(symbol)) continue;
        return {.kind = Token::Kind::symbol, .text = symbol, .begin = begin, .end = begin + symbol.size()};
    }
    const auto c = static_cast<unsigned char>(rest.front());
    const std::string shown =
        c > ' ' && c < 127 ? fmt::format("\"{}\"", rest.front()) : fmt::format("byte {:02X}h", c);
    throw LineMistake{fmt::format("{} has no meaning here; remove it (comments begin with # or //)", shown),
                      begin};
}

}  // namespace

std::vector<Token> tokens_of(std::string_view line) {
    std::vector<Token> tokens;
    std::size_t at = 0;
    while (at < line.size()) {
        const std::string_view rest = line.substr(at);
        if (rest.front() == ' ' || rest.front() == '\t' || rest.front() == '\r') {
            ++at;
            continue;
        }
        if (rest.front() == '#' || rest.starts_with("//")) break;
        if (is_digit(rest.front())) {
            tokens.push_back(number_at(rest, at));
        } else if (rest.front() == '"') {
            tokens.push_back(text_at(rest, at));
        } else if (is_word_start(rest.front())) {
            tokens.push_back(word_at(rest, at));
        } else {
            tokens.push_back(symbol_at(rest, at));
        }
        at = tokens.back().end;
    }
    tokens.push_back({.kind = Token::Kind::end, .text = {}, .begin = line.size(), .end = line.size()});
    return tokens;
}

const Token& Reader::peek(std::size_t ahead) const {
    return tokens_[std::min(position_ + ahead, tokens_.size() - 1)];
}

const Token& Reader::next() {
    const Token& token = peek();
    if (position_ + 1 < tokens_.size()) ++position_;
    return token;
}

bool Reader::is(std::string_view word_or_symbol, std::size_t ahead) const {
    const Token& token = peek(ahead);
    return (token.kind == Token::Kind::word || token.kind == Token::Kind::symbol) &&
           same_name(token.text, word_or_symbol);
}

bool Reader::take(std::string_view word_or_symbol) {
    if (!is(word_or_symbol)) return false;
    next();
    return true;
}

void Reader::want(std::string_view word_or_symbol, std::string_view what_to_write) {
    if (!take(word_or_symbol)) fail(what_to_write);
}

void Reader::fail(std::string_view what_to_write) const {
    const std::string found =
        at_end() ? "the line ends too early" : fmt::format("\"{}\" is out of place", peek().text);
    refuse_next(fmt::format("{}; write {}", found, what_to_write));
}

void Reader::refuse(const std::string& message) const {
    throw LineMistake{message, tokens_[position_ == 0 ? 0 : position_ - 1].begin};
}

void Reader::refuse_time(const std::string& message) const {
    throw LineMistake{message, tokens_[time_at_].begin};
}

void Reader::refuse_at(std::size_t mark, const std::string& message) const {
    throw LineMistake{message, tokens_[std::min(mark, tokens_.size() - 1)].begin};
}

std::string_view Reader::rest() {
    const std::size_t begin = peek().begin;
    position_ = tokens_.size() - 1;
    return trim(line_.substr(begin, tokens_[position_ == 0 ? 0 : position_ - 1].end - begin));
}

std::string Reader::source_since(std::size_t mark) const {
    if (position_ == mark) return {};
    return std::string(line_.substr(tokens_[mark].begin, tokens_[position_ - 1].end - tokens_[mark].begin));
}

double Reader::number(std::string_view what_to_write) {
    const bool negative = take("-");
    if (peek().kind != Token::Kind::number) fail(what_to_write);
    const double value = next().number;
    return negative ? -value : value;
}

/// A constant of the program.
std::optional<Time> Reader::named_time() const {
    if (peek().kind != Token::Kind::word) return std::nullopt;
    for (const auto& [name, milliseconds] : names_.times) {
        if (same_name(name, peek().text)) return std::chrono::milliseconds{milliseconds};
    }
    return std::nullopt;
}

bool Reader::starts_duration() const {
    const bool is_written = peek().kind == Token::Kind::number && peek(1).kind == Token::Kind::word &&
                            to_duration(peek().number, peek(1).text).has_value();
    return is_written || named_time().has_value();
}

bool Reader::starts_times() const {
    return peek().kind == Token::Kind::number && (is("times", 1) || is("time", 1));
}

std::uint64_t Reader::times() {
    const double value = number("a number of times");
    if (value < 0 || value != static_cast<double>(static_cast<std::uint32_t>(value)))
        refuse("a number of times is a whole number, such as 3 times");
    if (!take("times")) want("time", "times, such as 3 times");
    return static_cast<std::uint64_t>(value);
}

Time Reader::lasting() {
    if (!take("for")) return Time{0};
    const Time time = duration("a time after for, such as for 200 ms");
    if (time <= Time{0}) refuse_time("what lasts takes longer than 0; write such as for 200 ms");
    return time;
}

Window Reader::window(Time from) {
    Window window{.from = from, .until = {}};
    if (take("from")) window.from = duration("a time after from");
    if (!take("until")) return window;
    window.until = duration("a time after until");
    if (*window.until < window.from)
        refuse_time(fmt::format("this ends at {}, before it begins at {}; write the earlier time first",
                                in_words(*window.until), in_words(window.from)));
    return window;
}

Time Reader::duration(std::string_view what_to_write) {
    time_at_ = position_;
    if (const auto named = named_time()) {
        next();
        return *named;
    }
    if (peek().kind != Token::Kind::number) fail(what_to_write);
    const double value = peek().number;
    const Token& unit = peek(1);
    const auto time = to_duration(value, unit.kind == Token::Kind::word ? unit.text : "");
    if (!time) {
        refuse_next(
            fmt::format("\"{}{}{}\" is not a time; write a number with us, ms, s or min, such as 250 ms",
                        peek().text, unit.text.empty() ? "" : " ", unit.text));
    }
    next();
    next();
    return *time;
}

double Reader::percent(std::string_view what_to_write) {
    if (peek().kind != Token::Kind::number) fail(what_to_write);
    const double value = next().number;
    want("%", "a share with its sign, such as 1 %");
    if (value > 100) refuse("a share is 0 % to 100 %");
    return value / 100;
}

}  // namespace nplc::sim
