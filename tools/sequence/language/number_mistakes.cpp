#include "language/number_mistakes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "language/names.h"

namespace nplc::seqc {
namespace {

constexpr std::uint32_t kMostShown = 60;

bool is_next_to(const Token& first, const Token& second) {
    return second.span.offset == first.span.offset + first.span.length;
}

bool has_digit(std::string_view text) {
    return std::any_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::string_view beginning(const TokenStream& in, Span span) {
    return in.text_of({span.offset, std::min(span.length, kMostShown)});
}

}  // namespace

bool refuse_malformed_number(TokenStream& in, bool in_list) {
    const Token first = in.token();
    const auto touches = [&](std::size_t ahead) { return is_next_to(in.token(ahead - 1), in.token(ahead)); };
    const auto is_number = [&](std::size_t ahead) { return in.token(ahead).kind == TokenKind::number; };
    if (in.at_symbol(".") && is_number(1) && touches(1)) {
        in.report().add("E003", {first.span.offset, first.span.length + in.token(1).span.length},
                        fmt::format("'.{}' is not a number", in.token(1).text),
                        fmt::format("write 0.{}", in.token(1).text));
        in.skip(2);
        return true;
    }
    if (first.kind != TokenKind::number || first.text.size() != first.span.length) return false;
    std::size_t end = 1;
    while (in.is_symbol_at(end, ".") && is_number(end + 1) && touches(end) && touches(end + 1)) end += 2;
    if (in.token(end).kind == TokenKind::identifier && touches(end) && has_digit(in.token(end).text)) ++end;
    std::string help = "a number is written in digits, with at most one point, and its unit behind it";
    if (end == 1 && is_number(1) && in.is_symbol_at(2, "/") && !in_list) {
        const bool is_speed = in.token(1).text == "1" && is_one_of(in.token(3), {"min", "s"});
        end = 4;
        help = is_speed
                   ? fmt::format("write {} {}", first.text, is_one_of(in.token(3), {"min"}) ? "rpm" : "rev/s")
                   : "a number has no fraction behind it: write 1.5 for 1 1/2";
        if (!is_speed && in.token(3).kind != TokenKind::number) end = 3;
    } else if (end == 1) {
        std::string digits(first.text);
        while (is_number(end) && !in_list &&
               !has_line_end(in, first.span.offset, in.token(end).span.offset)) {
            digits.append("_").append(in.token(end).text);
            ++end;
        }
        if (end == 1) return false;
        help = fmt::format("digits are grouped with _ or not at all: write {}", digits);
    }
    in.skip(end);
    const Span span = in.span_since(first);
    in.report().add("E003", span, fmt::format("'{}' is not a number", beginning(in, span)), std::move(help));
    return true;
}

bool refuse_decimal_comma_in_time(TokenStream& in, const Token& literal) {
    const Token digits = in.token(1);
    if (!in.at_symbol(",") || !is_next_to(literal, in.token()) || digits.kind != TokenKind::number ||
        !is_next_to(in.token(), digits))
        return false;
    in.skip(2);
    std::string_view unit;
    if (in.token().kind == TokenKind::identifier && is_next_to(digits, in.token())) {
        unit = in.token().text;
        in.skip();
    }
    in.report().add("E004", in.span_since(literal), "a number has a decimal point",
                    fmt::format("write {}.{}{}", literal.text, digits.text, unit));
    return true;
}

bool refuse_rest_of_value(TokenStream& in, const Token& first, const Token& number, bool in_list) {
    constexpr std::array<std::string_view, 13> kUnits = {"mm", "cm",  "m", "rev", "counts", "deg", "rpm",
                                                         "ms", "min", "s", "h",   "V",      "mV"};
    const Token last = in.last();
    const Token digits = in.token(1);
    if (!in_list && in.at_symbol(",") && last.kind == TokenKind::number && digits.kind == TokenKind::number &&
        is_next_to(last, in.token()) && is_next_to(in.token(), digits)) {
        in.skip(2);
        const bool maybe_thousands = digits.text.size() == 3 && last.text != "0";
        in.report().add("E003", in.span_since(first), "a number has a decimal point",
                        maybe_thousands ? fmt::format("write {0}{1}, or {0}.{1} if the comma is one",
                                                      last.text, digits.text)
                                        : fmt::format("write {}.{}", last.text, digits.text));
        return true;
    }
    const bool is_second_unit =
        number.kind == TokenKind::number && last.kind == TokenKind::identifier && in.is_word_at(0) &&
        !in.is_symbol_at(1, ":=") && !has_line_end(in, last.span.offset, in.token().span.offset) &&
        std::any_of(kUnits.begin(), kUnits.end(),
                    [&](std::string_view known) { return same_name(in.token().text, known); });
    if (!is_second_unit) return false;
    in.skip();
    const Span span = in.span_since(number);
    in.report().add("E003", span, fmt::format("'{}' is not a value", beginning(in, span)),
                    "a value is a number with one unit, as 5 mm, and the unit is one word");
    return true;
}

}  // namespace nplc::seqc
