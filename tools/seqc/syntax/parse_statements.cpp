#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "syntax/foreign_words.h"
#include "syntax/names.h"
#include "syntax/parser.h"

namespace nplc::seqc {
namespace {

using ast::Statement;

std::string without_underscores(std::string_view text) {
    std::string digits;
    for (char c : text) {
        if (c != '_') digits += c;
    }
    return digits;
}

/// Digits and underscores, then perhaps a point and digits.
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

}  // namespace

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

bool Parser::parse_if(ast::Choice& choice) {
    const Span opened = token().span;
    bool last = false;
    std::size_t ends_too_many = 0;
    do {
        ast::Branch branch;
        branch.span = token().span;
        if (at("ELSE") && same_name(token(1).text, "IF")) {
            const Token first = token();
            ++at_;
            ++ends_too_many;
            report_.add("E010", {first.span.offset, token().span.offset + 2 - first.span.offset},
                        "an IF cannot stand inside another: ELSE IF is the word ELSIF",
                        "write ELSIF, and one END_IF for all of it");
        }
        last = at("ELSE");
        ++at_;
        if (!last) {
            branch.condition.emplace();
            if (!parse_expression(*branch.condition)) {
                branch.condition->kind = ast::Expression::Kind::constant;
                while (!at("THEN") && !at_boundary() && !at_symbol(";")) ++at_;
            }
            take_then();
        }
        parse_branch_body(branch, opened);
        choice.branches.push_back(std::move(branch));
    } while (!last && (at("ELSIF") || at("ELSE")));
    end_block("END_IF", opened);
    for (; ends_too_many > 0 && take("END_IF"); --ends_too_many) take_symbol(";");
    return true;
}

/// What stands too much between the condition and THEN is one mistake.
void Parser::take_then() {
    if (take("THEN") || (mend({"THEN"}, "THEN after the condition") && take("THEN"))) return;
    error_here("THEN after the condition",
               at_symbol(")") ? "there is no '(' for this ')'"
                              : "write IF condition THEN; AND, OR and XOR join two conditions");
    if (take_symbol(":")) return;
    const std::size_t before = at_;
    while (!at("THEN") && !at_boundary() && !at_symbol(";")) ++at_;
    if (!take("THEN")) at_ = before;
}

void Parser::parse_branch_body(ast::Branch& branch, Span opened) {
    while (!at("ELSIF") && !at("ELSE") && !at("END_STEP") && !at("STEP") && !at("POWER_UP") &&
           !at("END_POWER_UP") && !at_block_end("END_IF") && !report_.full()) {
        if (take_symbol(";")) continue;
        const std::size_t before = at_;
        mend_statement({"ELSIF", "ELSE", "END_IF"});
        if (at("ELSIF") || at("ELSE") || at("END_IF")) break;
        if (at("IF")) {
            ast::Choice inner;
            report_
                .add("E064", token().span, "an IF cannot stand inside another",
                     "join the two conditions with AND, or use ELSIF")
                .notes.push_back({opened, "the outer IF begins here"});
            parse_if(inner);
        } else if (at("OUT")) {
            report_.add("E064", token().span, "OUT cannot stand inside an IF",
                        "outputs belong to the step: write OUT Name WHEN condition; beside the IF");
            recover();
        } else {
            Statement statement;
            if (parse_statement(statement)) branch.statements.push_back(std::move(statement));
        }
        if (at_ == before) ++at_;
    }
}

bool Parser::parse_statement(Statement& statement) {
    const Token first = token();
    if (take("EVERY_SCAN")) {
        statement.every_scan = true;
        statement.every_scan_span = first.span;
    }
    if (!parse_simple_statement(statement)) {
        recover();
        return false;
    }
    statement.span = span_since(first);
    end_statement();
    return true;
}

bool Parser::parse_target(ast::Name& name) {
    if (!at("POWER_UP")) return expect_name(name, "the name of a step");
    name = name_of(token());
    ++at_;
    return true;
}

bool Parser::parse_simple_statement(Statement& statement) {
    if (take("NEXT")) {
        statement.kind = Statement::Kind::next;
        if (is_word_at(0)) {
            error_here("':=' after NEXT", fmt::format("write NEXT := {};", token().text));
        } else if (!expect_symbol(":=", "after NEXT"))
            return false;
        return parse_target(statement.name);
    }
    if (take("COUNT_DOWN")) {
        statement.kind = Statement::Kind::count_down;
        return true;
    }
    if (take("CLEAR_COUNTER")) {
        statement.kind = Statement::Kind::clear_counter;
        return true;
    }
    if (at("TIMER") || at("COUNTER")) {
        statement.kind = at("TIMER") ? Statement::Kind::timer : Statement::Kind::counter;
        const ForeignWord* usual = foreign_word(at("TIMER") ? "TON" : "CTU");
        ++at_;
        const bool is_preset = at_symbol(":=") || at_symbol("=");
        if (!is_preset || same_name(token(1).text, "COUNTER") || same_name(token(1).text, "TIMER")) {
            error_here("':=' and a constant to preset it", std::string(usual->help));
            return false;
        }
        return expect_symbol(":=", "to preset it, as in TIMER := T#500ms;") && parse_value(statement.value);
    }
    if (take("REG")) {
        statement.kind = Statement::Kind::assign_number;
        return parse_register_number(statement.register_number) &&
               expect_symbol(":=", "after the register") && parse_value(statement.value);
    }
    if (refuse_foreign_word()) return false;
    if (token().kind == TokenKind::identifier && is_reserved(token().text)) {
        error_here("a statement", "statements are NEXT := Step; TIMER := T#1s; commands and register values");
        return false;
    }
    if (!expect_name(statement.name, "a statement")) return false;
    if (at_symbol(":=")) return parse_assignment(statement);
    if (at_symbol("=")) {
        error_here(fmt::format("':=' after {}", statement.name.text), "write := with a colon");
        return parse_assignment(statement);
    }
    statement.kind = Statement::Kind::command;
    return !at_symbol("(") || parse_arguments(statement);
}

bool Parser::parse_assignment(Statement& statement) {
    ++at_;
    statement.kind = Statement::Kind::assign;
    return parse_value(statement.value);
}

bool Parser::parse_arguments(Statement& statement) {
    ++at_;
    statement.has_arguments = true;
    if (take_symbol(")")) return true;
    do {
        if (token().kind != TokenKind::identifier && token().kind != TokenKind::number) {
            error_here("a register or a number");
            return false;
        }
        const Token first = token();
        if (first.kind == TokenKind::number && is_word_at(1)) {
            ast::Value value;
            if (!parse_value(value)) return false;
            report_.add("E050", span_since(first),
                        fmt::format("{} takes a register, not a value", upper(statement.name.text)),
                        fmt::format("name a register with this value in VAR_MOTOR, as in Place AT P1 := 80 "
                                    "mm; and write {}(Place)",
                                    upper(statement.name.text)));
            while (!at_symbol(")") && !at_symbol(";") && !at_boundary()) ++at_;
            return false;
        }
        statement.arguments.push_back(name_of(token()));
        ++at_;
    } while (take_symbol(","));
    return expect_symbol(")", "to close the list");
}

bool Parser::parse_register_number(std::optional<ast::Value>& number) {
    if (!expect_symbol("(", "after REG, as in REG(33)")) return false;
    number.emplace();
    if (!parse_value(*number)) return false;
    return expect_symbol(")", "after the register's number");
}

bool Parser::parse_value(ast::Value& value) {
    const Token first = token();
    const bool negative = take_symbol("-");
    if (!negative) take_symbol("+");
    const Token literal = token();
    const bool is_literal = literal.kind == TokenKind::number || literal.kind == TokenKind::based ||
                            literal.kind == TokenKind::time;
    if (!is_literal) {
        error_here(
            "a value",
            at("TRUE") || at("FALSE")
                ? "an output belongs to its step: OUT Name; or OUT Name WHEN condition;"
                : "only constants can be written; a register's value is brought in by selecting it, as "
                  "in POSITION(P1), and another step is named with NEXT := Name;");
        return false;
    }
    ++at_;
    const Code code = literal.kind == TokenKind::time ? Code("E004") : Code("E003");
    bool sound = false;
    if (literal.kind == TokenKind::number) sound = to_number(literal.text, value.number);
    if (literal.kind == TokenKind::based) sound = to_based(literal.text, value.number);
    if (literal.kind == TokenKind::time) sound = parse_time(literal.text, value.number);
    if (!sound || (negative && literal.kind != TokenKind::number)) {
        report_.add(code, literal.span, fmt::format("'{}' is not a value", literal.text.substr(0, 60)),
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
    value.span = span_since(first);
    return !refuse_decimal_comma(first);
}

/// 80,5 mm; in a TERM the comma parts two bytes.
bool Parser::refuse_decimal_comma(const Token& first) {
    const Token& last = tokens_[at_ - 1];
    const Token& digits = token(1);
    const bool touches = token().span.offset == last.span.offset + last.span.length &&
                         digits.span.offset == token().span.offset + 1;
    if (in_term_ || !at_symbol(",") || last.kind != TokenKind::number || digits.kind != TokenKind::number ||
        !touches)
        return false;
    at_ += 2;
    report_.add("E003", span_since(first), "a number has a decimal point",
                fmt::format("write {}.{}", last.text, digits.text));
    return true;
}

void Parser::parse_unit(ast::Value& value) {
    const Token first = token();
    if (first.kind == TokenKind::direct) {
        value.unit = name_of(first);
        ++at_;
        return;
    }
    if (first.kind != TokenKind::identifier || is_reserved(first.text)) return;
    ++at_;
    std::string written(first.text);
    for (; at_symbol("/") && token(1).kind == TokenKind::identifier; at_ += 2)
        written.append("/").append(token(1).text);
    value.unit.span = span_since(first);
    value.unit.text = source_.substr(value.unit.span.offset, value.unit.span.length);
    if (value.unit.text.size() == written.size()) return;
    value.unit.text = texts_.emplace_back(std::move(written));
}

bool Parser::parse_raw_term(std::vector<ast::RawTerm>& terms) {
    const Token first = token();
    ++at_;
    if (at_symbolic_term()) return parse_symbolic_term(first, terms);
    ast::RawTerm term;
    bool sound = true;
    do {
        ast::Value value;
        in_term_ = true;
        const bool is_value = parse_value(value);
        in_term_ = false;
        if (!is_value) return false;
        const bool is_byte = value.number >= 0 && value.number <= 255 &&
                             std::floor(value.number) == value.number && value.unit.text.empty() &&
                             !value.is_time;
        if (!is_byte) {
            report_.add("E090", value.span, "this is not a byte", "write 0..255 or 16#00..16#FF");
            sound = false;
            continue;
        }
        term.bytes.push_back(static_cast<std::uint8_t>(value.number));
    } while (take_symbol(","));
    term.span = span_since(first);
    if (sound && term.bytes.size() != 8) {
        report_.add("E090", term.span, fmt::format("a term has 8 bytes, here are {}", term.bytes.size()),
                    "write all eight: STATE, INPUT, CARE, NEXT_STATE and four bytes more (001 §6.1)");
        sound = false;
    }
    if (sound) terms.push_back(std::move(term));
    end_statement();
    return true;
}

}  // namespace nplc::seqc
