#include <fmt/format.h>

#include <array>

#include "language/names.h"
#include "language/parser.h"

namespace nplc::seqc {
namespace {

using ast::Expression;
using Kind = ast::Expression::Kind;

struct Operator {
    std::string_view word;
    Kind kind;
};

/// Lowest precedence first, as in IEC 61131-3.
constexpr std::array kOperators = {
    Operator{"OR", Kind::any_of},
    Operator{"XOR", Kind::odd_of},
    Operator{"AND", Kind::all_of},
};

}  // namespace

bool Parser::parse_expression(Expression& result) {
    return parse_operators(result, 0);
}

bool Parser::parse_operators(Expression& result, std::size_t level) {
    if (level == kOperators.size()) {
        const Token first = token();
        const std::size_t errors_before = report_.error_count();
        if (!parse_primary(result)) return false;
        if (at_comparison()) return refuse_comparison(first, result, report_.error_count() > errors_before);
        if (at("FOR") || at("WITHIN")) return true;
        mend({"AND", "OR", "XOR"}, "AND, OR, XOR or the end of the condition");
        return true;
    }
    const Token first = token();
    if (!parse_operators(result, level + 1)) return false;
    if (!at(kOperators[level].word)) return true;
    Expression joined;
    joined.kind = kOperators[level].kind;
    joined.operands.push_back(std::move(result));
    while (take(kOperators[level].word)) {
        Expression operand;
        if (!parse_operators(operand, level + 1)) return false;
        joined.operands.push_back(std::move(operand));
    }
    joined.span = span_since(first);
    result = std::move(joined);
    return true;
}

bool Parser::parse_primary(Expression& result) {
    const bool before_operand = is_word_at(1) || (token(1).kind == TokenKind::symbol && token(1).text == "(");
    if (before_operand) mend({"NOT"}, "a condition");
    if (refuse_misplaced_time() && at("THEN")) {
        result = {};
        return true;
    }
    const Token first = token();
    if (depth_ == kDeepest && (at("NOT") || at_symbol("("))) {
        report_.add("E013", first.span, "this condition is nested too deeply",
                    "split it with ELSIF or more steps");
        return false;
    }
    if (take("NOT")) {
        result.kind = Kind::negation;
        result.operands.emplace_back();
        ++depth_;
        const bool sound = parse_primary(result.operands.back());
        --depth_;
        result.span = span_since(first);
        return sound;
    }
    if (take_symbol("(")) {
        ++depth_;
        const bool sound = parse_expression(result);
        --depth_;
        if (sound) refuse_misplaced_time();
        return sound && expect_symbol(")", "to close the parenthesis");
    }
    const bool sound = parse_named_primary(result);
    result.span = span_since(first);
    return sound;
}

bool Parser::parse_named_primary(Expression& result) {
    if (is_symbol_at(1, ".") && !mend_numbered_timer()) mend({"TIMER", "COUNTER"}, "a condition");
    if (in_property_ && at("STEP")) return parse_step_test(result);
    if (at_edge()) return parse_edge(result);
    if (refuse_call_or_part() || refuse_time_as_condition(result)) return true;
    if (at("TRUE") || at("FALSE")) {
        result.kind = Kind::constant;
        result.value = at("TRUE");
        ++at_;
        return true;
    }
    if (take("INPOS")) {
        result.kind = Kind::in_pos;
        return true;
    }
    if (take("ERROR")) {
        result.kind = Kind::error;
        return true;
    }
    if (take("ANY")) {
        result.kind = Kind::any_error;
        return expect("ERROR", "after ANY");
    }
    if (at("TIMER") || at("COUNTER")) {
        result.kind = at("TIMER") ? Kind::timer_q : Kind::counter_q;
        const Token first = token();
        ++at_;
        if (take_symbol(".") && take("Q")) return true;
        if (is_word_at(0)) ++at_;
        report_.add("E014", span_since(first),
                    "only TIMER.Q and COUNTER.Q can be tested: they are true at zero",
                    "write TIMER.Q or COUNTER.Q");
        return false;
    }
    if (token().kind == TokenKind::direct) {
        result.kind = Kind::name;
        result.name = name_of(token());
        note_use(ast::Role::address, token().span);
        ++at_;
        return true;
    }
    const std::string_view expected = "an input, INPOS, ERROR, TIMER.Q or COUNTER.Q";
    if (at("THEN") || at("AND") || at("OR") || at("XOR")) {
        const bool joins = !at("THEN");
        error_here(
            expected,
            joins
                ? "two conditions are joined by one word, AND, OR or XOR, and an empty one cannot be"
                : "write what must hold, as in IF Start THEN; what happens in any case stands without an IF");
        return false;
    }
    if (at_symbol("/")) {
        error_here(expected, "write NOT in front of what must be off");
        return false;
    }
    result.kind = Kind::name;
    return expect_name(result.name, expected, ast::Role::tested);
}

bool Parser::at_edge() const {
    if (in_property_) return false;
    const bool is_rising = at("R_TRIG");
    return (at("F_TRIG") || is_rising) && is_symbol_at(1, "(");
}

/// R_TRIG(Start)
bool Parser::parse_edge(Expression& result) {
    const Token first = token();
    result.kind = at("R_TRIG") ? Kind::rising : Kind::falling;
    note_use(ast::Role::keyword, first.span);
    at_ += 2;
    const bool is_direct = token().kind == TokenKind::direct;
    if ((!is_direct && !is_word_at(0)) || !is_symbol_at(1, ")")) {
        while (!at_symbol(")") && !at("THEN") && !at_symbol(";") && !at_boundary()) ++at_;
        take_symbol(")");
        report_.add("E014", span_since(first), fmt::format("{} takes the name of one input", first.text),
                    "write R_TRIG(Start); two edges are joined outside: R_TRIG(A) OR R_TRIG(B)");
        result = {};
        return true;
    }
    result.name = name_of(token());
    note_use(is_direct ? ast::Role::address : ast::Role::tested, token().span);
    at_ += 2;
    return true;
}

bool Parser::at_symbolic_term() const {
    return at("IF") || (token().kind == TokenKind::identifier && token(1).kind == TokenKind::symbol &&
                        token(1).text == ":");
}

bool Parser::parse_symbolic_term(const Token& first, std::vector<ast::RawTerm>& terms) {
    ast::RawTerm term;
    ast::SymbolicTerm& symbols = term.symbols.emplace();
    bool has_name = true;
    if (!at("IF")) {
        has_name = expect_name(symbols.step, "the name of a step", ast::Role::step);
        at_ += has_name ? 1 : 2;
    }
    const Span opened = token().span;
    if (!expect("IF", "after the step's name, as in TERM Idle: IF Start THEN ... END_IF;")) return false;
    if (!parse_expression(symbols.condition)) {
        symbols.condition.kind = ast::Expression::Kind::constant;
        while (!at("THEN") && !at_boundary() && !at_symbol(";")) ++at_;
    }
    if (!take("THEN")) error_here("THEN after the condition");
    parse_symbolic_body(symbols);
    if (at("ELSIF") || at("ELSE")) {
        report_.add("E094", token().span, "a TERM is one term, which has one condition",
                    "write another TERM; the last that holds decides");
        while (!at_block_end("END_IF")) ++at_;
    }
    end_block("END_IF", opened);
    term.span = span_since(first);
    if (has_name) terms.push_back(std::move(term));
    return true;
}

void Parser::parse_symbolic_body(ast::SymbolicTerm& term) {
    while (!at_boundary() && !report_.full()) {
        if (take_symbol(";")) continue;
        if (take("OUT")) {
            if (parse_outputs(term.outputs)) {
                end_statement();
            } else {
                recover();
            }
            continue;
        }
        const std::size_t before = at_;
        ast::Statement statement;
        if (parse_statement(statement)) term.statements.push_back(std::move(statement));
        if (at_ == before) ++at_;
    }
}

}  // namespace nplc::seqc
