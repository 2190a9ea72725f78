#include "language/value_parser.h"

#include <fmt/format.h>

#include <charconv>

#include "language/names.h"
#include "language/number_mistakes.h"
#include "language/reserved_words.h"

namespace nplc::seqc {
namespace {

std::string without_underscores(std::string_view text) {
    std::string digits;
    for (char c : text) {
        if (c != '_') digits += c;
    }
    return digits;
}

/// Digits and underscores, then optionally a point and digits.
bool to_number(std::string_view text, double& number) {
    const std::size_t point = text.find('.');
    if (point != text.npos && text.find('_', point) != text.npos) return false;
    const std::string digits = without_underscores(text);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return error == std::errc() && end == digits.data() + digits.size();
}

bool to_based(std::string_view text, double& number) {
    const std::size_t mark = text.find('#');
    const std::string_view base_text = text.substr(0, mark);
    const int base = base_text == "16" ? 16 : base_text == "8" ? 8 : base_text == "2" ? 2 : 0;
    const std::string digits = without_underscores(text.substr(mark + 1));
    std::uint32_t value = 0;
    if (base == 0 || digits.empty()) return false;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
    number = value;
    return error == std::errc() && end == digits.data() + digits.size();
}

double milliseconds_of(std::string_view unit) {
    if (same_name(unit, "ms")) return 1;
    if (same_name(unit, "s")) return 1000;
    if (same_name(unit, "m")) return 60'000;
    if (same_name(unit, "h")) return 3'600'000;
    if (same_name(unit, "d")) return 86'400'000;
    return 0;
}

bool is_digit_of_time(char c) {
    return c >= '0' && c <= '9';
}
bool is_number_char(char c) {
    return is_digit_of_time(c) || c == '.' || c == '_';
}

/// Milliseconds of T#1s500ms; false if it is malformed.
bool parse_time(std::string_view text, double& milliseconds) {
    std::string_view rest = text.substr(text.find('#') + 1);
    milliseconds = 0;
    double previous_unit = 1e12;
    while (!rest.empty()) {
        std::size_t count = 0;
        while (count < rest.size() && is_number_char(rest[count])) ++count;
        std::size_t letters = count;
        while (letters < rest.size() && !is_number_char(rest[letters])) ++letters;
        double number = 0;
        const double unit = milliseconds_of(rest.substr(count, letters - count));
        if (!is_digit_of_time(rest.front()) || unit == 0 || unit >= previous_unit ||
            !to_number(rest.substr(0, count), number))
            return false;
        milliseconds += number * unit;
        previous_unit = unit;
        rest.remove_prefix(letters);
    }
    return previous_unit < 1e12;
}

ast::Value wrapped(ast::Value::Kind kind, ast::Value operand) {
    ast::Value result;
    result.kind = kind;
    result.span = operand.span;
    result.operands.push_back(std::move(operand));
    return result;
}

}  // namespace

bool ValueParser::parse(ast::Value& value) {
    in_arithmetic_ = true;
    const bool is_value = parse_sum(value);
    in_arithmetic_ = false;
    return is_value;
}

bool ValueParser::parse_sum(ast::Value& value) {
    const Token first = in_.token();
    if (!parse_product(value)) return false;
    if (!in_.at_symbol("+") && !in_.at_symbol("-")) return true;
    ast::Value sum;
    sum.kind = ast::Value::Kind::sum;
    sum.operands.push_back(std::move(value));
    while (in_.at_symbol("+") || in_.at_symbol("-")) {
        const bool taken_off = in_.at_symbol("-");
        in_.skip();
        ast::Value operand;
        if (!parse_product(operand)) return false;
        sum.operands.push_back(taken_off ? wrapped(ast::Value::Kind::negation, std::move(operand))
                                         : std::move(operand));
    }
    sum.span = in_.span_since(first);
    value = std::move(sum);
    return true;
}

bool ValueParser::parse_product(ast::Value& value) {
    const Token first = in_.token();
    if (!parse_factor(value)) return false;
    if (refuse_modulo(value)) return true;
    if (!in_.at_symbol("*") && !in_.at_symbol("/")) return true;
    ast::Value product;
    product.kind = ast::Value::Kind::product;
    product.operands.push_back(std::move(value));
    while (in_.at_symbol("*") || in_.at_symbol("/")) {
        const bool divides = in_.at_symbol("/");
        in_.skip();
        ast::Value operand;
        if (!parse_factor(operand)) return false;
        product.operands.push_back(divides ? wrapped(ast::Value::Kind::inverse, std::move(operand))
                                           : std::move(operand));
    }
    product.span = in_.span_since(first);
    value = std::move(product);
    return true;
}

bool ValueParser::parse_factor(ast::Value& value) {
    const Token first = in_.token();
    in_.note_place(ast::Role::constant);
    if (in_.at_deepest() && (in_.at_symbol("(") || in_.at_symbol("-") || in_.at_symbol("+"))) {
        in_.report().add("E013", first.span, "this value is nested too deeply",
                         "give a part of it a name: CONST");
        return false;
    }
    if (in_.take_symbol("(")) {
        const bool sound = in_.nested([&] { return parse(value); });
        if (!sound || !in_.expect_symbol(")", "to close the parenthesis")) return false;
        value.span = in_.span_since(first);
        return true;
    }
    const bool has_sign = in_.at_symbol("-") || in_.at_symbol("+");
    if (has_sign && (in_.is_word_at(1) || in_.is_symbol_at(1, "("))) {
        const bool negative = in_.at_symbol("-");
        in_.skip();
        const bool sound = in_.nested([&] { return parse_factor(value); });
        if (!sound || !negative) return sound;
        value = wrapped(ast::Value::Kind::negation, std::move(value));
        value.span = in_.span_since(first);
        return true;
    }
    if (in_.is_word_at(0)) return parse_name(value);
    return parse_literal(value);
}

/// Pitch, GP_MODE, or BY_COMMAND = HOME2_MODE.
bool ValueParser::parse_name(ast::Value& value) {
    const Token first = in_.token();
    value.kind = ast::Value::Kind::name;
    value.name = name_of(first);
    notes_.add_use(ast::Role::constant, first.span);
    in_.skip();
    if (in_.take_symbol("=")) {
        value.kind = ast::Value::Kind::part;
        ast::Value& chosen = value.operands.emplace_back();
        if (in_.is_word_at(0)) {
            chosen.kind = ast::Value::Kind::name;
            chosen.name = name_of(in_.token());
            chosen.span = in_.token().span;
            notes_.add_use(ast::Role::constant, chosen.span);
            in_.skip();
        } else if (!parse_literal(chosen)) {
            return false;
        }
    }
    value.span = in_.span_since(first);
    return true;
}

/// 7 MOD 4: MOD is parsed as the unit of 7.
bool ValueParser::refuse_modulo(ast::Value& value) {
    const bool is_unit = same_name(value.unit.text, "MOD") || same_name(value.unit.text, "DIV");
    if (!is_unit || in_.at_symbol(";")) return false;
    in_.report().add("E045", value.unit.span, fmt::format("there is no {} here", upper(value.unit.text)),
                     "values are calculated with + - * / and parentheses");
    value.unit = {};
    ast::Value dropped;
    parse_factor(dropped);
    return true;
}

bool ValueParser::parse_register_number(std::optional<ast::Value>& number) {
    if (!in_.expect_symbol("(", "after REG, as in REG(33)")) return false;
    number.emplace();
    if (!parse_literal(*number)) return false;
    return in_.expect_symbol(")", "after the register's number");
}

bool ValueParser::parse_literal(ast::Value& value, bool in_list) {
    const Token first = in_.token();
    const bool negative = in_.take_symbol("-");
    if (!negative) in_.take_symbol("+");
    if (Expected* expected = in_.expected_here()) expected->value = true;
    const Token literal = in_.token();
    if (refuse_malformed_number(in_, in_list)) return false;
    const bool is_literal = literal.kind == TokenKind::number || literal.kind == TokenKind::based ||
                            literal.kind == TokenKind::time;
    if (!is_literal) {
        in_.error_here(
            "a value",
            in_.at("TRUE") || in_.at("FALSE")
                ? "an output belongs to its step: OUT Name; or OUT Name WHEN condition;"
                : "only constants can be written; a register's value is brought in by selecting it, as "
                  "in POSITION(P1), and another step is named with NEXT := Name;");
        return false;
    }
    in_.skip();
    const Code code = literal.kind == TokenKind::time ? Code("E004") : Code("E003");
    bool sound = false;
    if (literal.kind == TokenKind::number) sound = to_number(literal.text, value.number);
    if (literal.kind == TokenKind::based) sound = to_based(literal.text, value.number);
    if (literal.kind == TokenKind::time) sound = parse_time(literal.text, value.number);
    if (!sound && literal.kind == TokenKind::time && refuse_decimal_comma_in_time(in_, literal)) return false;
    if (!sound || (negative && literal.kind != TokenKind::number)) {
        in_.report().add(code, literal.span, fmt::format("'{}' is not a value", literal.text.substr(0, 60)),
                         literal.kind == TokenKind::time ? "write times as T#500ms or T#1s500ms"
                         : literal.kind == TokenKind::based
                             ? "write 16#C0, 8#300 or 2#1100_0000, up to 32 bits, no sign"
                         : literal.text.find('.') < literal.text.find('_')
                             ? "write 1_000.5: underscores stand before the point"
                             : "no register takes a number of this size");
        return false;
    }
    value.is_raw = literal.kind == TokenKind::based;
    value.is_time = literal.kind == TokenKind::time;
    if (negative) value.number = -value.number;
    if (literal.kind == TokenKind::number) parse_unit(value);
    value.span = in_.span_since(first);
    return !refuse_rest_of_value(in_, first, literal, in_list);
}

void ValueParser::parse_unit(ast::Value& value) {
    const Token first = in_.token();
    if (Expected* expected = in_.expected_here()) expected->unit = true;
    if (first.kind == TokenKind::direct) {
        value.unit = name_of(first);
        in_.skip();
        return;
    }
    if (same_name(in_.token().text, "IN") && (in_.is_symbol_at(1, ";") || in_.is_symbol_at(1, "/"))) {
        while (!in_.at_symbol(";") && !in_.at_boundary()) in_.skip();
        in_.report().add("E043", in_.span_since(first), "there are no inches here",
                         "write it in mm: 1 inch is 25.4 mm");
        return;
    }
    if (first.kind != TokenKind::identifier || is_reserved(first.text)) return;
    in_.skip();
    std::string written(first.text);
    for (; in_.at_symbol("/") && in_.token(1).kind == TokenKind::identifier &&
           !(in_arithmetic_ && in_.is_symbol_at(2, "="));
         in_.skip(2))
        written.append("/").append(in_.token(1).text);
    value.unit.span = in_.span_since(first);
    value.unit.text = in_.text_of(value.unit.span);
    notes_.add_use(ast::Role::unit, value.unit.span);
    if (value.unit.text.size() == written.size()) return;
    value.unit.text = notes_.keep(std::move(written));
}

bool ValueParser::expect_time(ast::Value& time, std::string_view word) {
    if (!in_.at("THEN") && !in_.at_symbol(";")) return parse(time);
    in_.error_here("a time", fmt::format("write {} T#500ms", word));
    return false;
}

}  // namespace nplc::seqc
