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
        const Token first = in_.token();
        const std::size_t errors_before = in_.report().error_count();
        if (!parse_primary(result)) return false;
        if (at_comparison())
            return refuse_comparison(first, result, in_.report().error_count() > errors_before);
        if (in_.at("FOR") || in_.at("WITHIN")) return true;
        in_.mend({"AND", "OR", "XOR"}, "AND, OR, XOR or the end of the condition");
        return true;
    }
    const Token first = in_.token();
    if (!parse_operators(result, level + 1)) return false;
    if (!in_.at(kOperators[level].word)) return true;
    Expression joined;
    joined.kind = kOperators[level].kind;
    joined.operands.push_back(std::move(result));
    while (in_.take(kOperators[level].word)) {
        Expression operand;
        if (!parse_operators(operand, level + 1)) return false;
        joined.operands.push_back(std::move(operand));
    }
    joined.span = in_.span_since(first);
    result = std::move(joined);
    return true;
}

bool Parser::parse_primary(Expression& result) {
    const bool before_operand =
        in_.is_word_at(1) || (in_.token(1).kind == TokenKind::symbol && in_.token(1).text == "(");
    if (before_operand) in_.mend({"NOT"}, "a condition");
    if (refuse_misplaced_time() && in_.at("THEN")) {
        result = {};
        return true;
    }
    const Token first = in_.token();
    if (in_.at_deepest() && (in_.at("NOT") || in_.at_symbol("("))) {
        in_.report().add("E013", first.span, "this condition is nested too deeply",
                         "split it with ELSIF or more steps");
        return false;
    }
    if (in_.take("NOT")) {
        result.kind = Kind::negation;
        result.operands.emplace_back();
        const bool sound = in_.nested([&] { return parse_primary(result.operands.back()); });
        result.span = in_.span_since(first);
        return sound;
    }
    if (in_.take_symbol("(")) {
        const bool sound = in_.nested([&] { return parse_expression(result); });
        if (sound) refuse_misplaced_time();
        return sound && in_.expect_symbol(")", "to close the parenthesis");
    }
    const bool sound = parse_named_primary(result);
    result.span = in_.span_since(first);
    return sound;
}

bool Parser::parse_named_primary(Expression& result) {
    if (in_.is_symbol_at(1, ".") && !mend_numbered_timer()) in_.mend({"TIMER", "COUNTER"}, "a condition");
    if (in_property_ && in_.at("STEP")) return parse_step_test(result);
    if (at_edge()) return parse_edge(result);
    if (refuse_call_or_part() || refuse_time_as_condition(result)) return true;
    if (in_.at("TRUE") || in_.at("FALSE")) {
        result.kind = Kind::constant;
        result.value = in_.at("TRUE");
        in_.skip();
        return true;
    }
    if (in_.take("INPOS")) {
        result.kind = Kind::in_pos;
        return true;
    }
    if (in_.take("ERROR")) {
        result.kind = Kind::error;
        return true;
    }
    if (in_.take("ANY")) {
        result.kind = Kind::any_error;
        return in_.expect("ERROR", "after ANY");
    }
    if (in_.at("TIMER") || in_.at("COUNTER")) {
        result.kind = in_.at("TIMER") ? Kind::timer_q : Kind::counter_q;
        const Token first = in_.token();
        in_.skip();
        if (in_.take_symbol(".") && in_.take("Q")) return true;
        if (in_.is_word_at(0)) in_.skip();
        in_.report().add("E014", in_.span_since(first),
                         "only TIMER.Q and COUNTER.Q can be tested: they are true at zero",
                         "write TIMER.Q or COUNTER.Q");
        return false;
    }
    if (in_.token().kind == TokenKind::direct) {
        result.kind = Kind::name;
        result.name = name_of(in_.token());
        notes_.add_use(ast::Role::address, in_.token().span);
        in_.skip();
        return true;
    }
    const std::string_view expected = "an input, INPOS, ERROR, TIMER.Q or COUNTER.Q";
    if (in_.at("THEN") || in_.at("AND") || in_.at("OR") || in_.at("XOR")) {
        const bool joins = !in_.at("THEN");
        in_.error_here(
            expected,
            joins
                ? "two conditions are joined by one word, AND, OR or XOR, and an empty one cannot be"
                : "write what must hold, as in IF Start THEN; what happens in any case stands without an IF");
        return false;
    }
    if (in_.at_symbol("/")) {
        in_.error_here(expected, "write NOT in front of what must be off");
        return false;
    }
    result.kind = Kind::name;
    return notes_.expect_name(result.name, expected, ast::Role::tested);
}

bool Parser::at_edge() const {
    if (in_property_) return false;
    const bool is_rising = in_.at("R_TRIG");
    return (in_.at("F_TRIG") || is_rising) && in_.is_symbol_at(1, "(");
}

/// R_TRIG(Start)
bool Parser::parse_edge(Expression& result) {
    const Token first = in_.token();
    result.kind = in_.at("R_TRIG") ? Kind::rising : Kind::falling;
    notes_.add_use(ast::Role::keyword, first.span);
    in_.skip(2);
    const bool is_direct = in_.token().kind == TokenKind::direct;
    if ((!is_direct && !in_.is_word_at(0)) || !in_.is_symbol_at(1, ")")) {
        while (!in_.at_symbol(")") && !in_.at("THEN") && !in_.at_symbol(";") && !in_.at_boundary())
            in_.skip();
        in_.take_symbol(")");
        in_.report().add("E014", in_.span_since(first),
                         fmt::format("{} takes the name of one input", first.text),
                         "write R_TRIG(Start); two edges are joined outside: R_TRIG(A) OR R_TRIG(B)");
        result = {};
        return true;
    }
    result.name = name_of(in_.token());
    notes_.add_use(is_direct ? ast::Role::address : ast::Role::tested, in_.token().span);
    in_.skip(2);
    return true;
}

bool Parser::at_symbolic_term() const {
    return in_.at("IF") || (in_.token().kind == TokenKind::identifier &&
                            in_.token(1).kind == TokenKind::symbol && in_.token(1).text == ":");
}

bool Parser::parse_symbolic_term(const Token& first, std::vector<ast::RawTerm>& terms) {
    ast::RawTerm term;
    ast::SymbolicTerm& symbols = term.symbols.emplace();
    bool has_name = true;
    if (!in_.at("IF")) {
        has_name = notes_.expect_name(symbols.step, "the name of a step", ast::Role::step);
        in_.skip(has_name ? 1 : 2);
    }
    const Span opened = in_.token().span;
    if (!in_.expect("IF", "after the step's name, as in TERM Idle: IF Start THEN ... END_IF;")) return false;
    if (!parse_expression(symbols.condition)) {
        symbols.condition.kind = ast::Expression::Kind::constant;
        while (!in_.at("THEN") && !in_.at_boundary() && !in_.at_symbol(";")) in_.skip();
    }
    if (!in_.take("THEN")) in_.error_here("THEN after the condition");
    parse_symbolic_body(symbols);
    if (in_.at("ELSIF") || in_.at("ELSE")) {
        in_.report().add("E094", in_.token().span, "a TERM is one term, which has one condition",
                         "write another TERM; the last that holds decides");
        while (!in_.at_block_end("END_IF")) in_.skip();
    }
    notes_.end_block("END_IF", opened);
    term.span = in_.span_since(first);
    if (has_name) terms.push_back(std::move(term));
    return true;
}

void Parser::parse_symbolic_body(ast::SymbolicTerm& term) {
    while (!in_.at_boundary() && !in_.report().full()) {
        if (in_.take_symbol(";")) continue;
        if (in_.take("OUT")) {
            if (parse_outputs(term.outputs)) {
                in_.end_statement();
            } else {
                in_.recover();
            }
            continue;
        }
        const std::size_t before = in_.position();
        ast::Statement statement;
        if (parse_statement(statement)) term.statements.push_back(std::move(statement));
        if (in_.position() == before) in_.skip();
    }
}

}  // namespace nplc::seqc
