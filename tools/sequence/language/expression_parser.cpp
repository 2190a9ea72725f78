#include "language/expression_parser.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "language/condition_mistakes.h"
#include "language/names.h"

namespace nplc::seqc {
namespace {

using ast::Expression;
using Kind = ast::Expression::Kind;

struct Operator {
    std::string_view word;
    Kind kind;
};

/// Lowest precedence first, as in IEC 61131-3.
constexpr std::array kConnectives = {
    Operator{"OR", Kind::any_of},
    Operator{"XOR", Kind::odd_of},
    Operator{"AND", Kind::all_of},
};

bool at_edge(const TokenStream& in) {
    const bool is_rising = in.at("R_TRIG");
    return (in.at("F_TRIG") || is_rising) && in.is_symbol_at(1, "(");
}

}  // namespace

bool ExpressionParser::parse_single(Expression& result, bool another_follows) {
    another_follows_ = another_follows;
    const bool sound = parse_primary(result);
    another_follows_ = false;
    return sound;
}

bool ExpressionParser::parse_operators(Expression& result, std::size_t level) {
    if (level == kConnectives.size()) {
        const Token first = in_.token();
        const std::size_t errors_before = in_.report().error_count();
        if (!parse_primary(result)) return false;
        if (!in_property_) refuse_edge_behind(in_, first, result);
        if (!in_property_ && at_comparison(in_))
            return refuse_comparison(in_, values_, first, result, in_.report().error_count() > errors_before);
        if (in_.at("FOR") || in_.at("WITHIN")) return true;
        if (!in_property_ && refuse_arithmetic(in_)) return true;
        mend_foreign_word(in_, true);
        in_.mend({"AND", "OR", "XOR"}, "AND, OR, XOR or the end of the condition");
        return true;
    }
    const Token first = in_.token();
    if (!parse_operators(result, level + 1)) return false;
    if (!in_.at(kConnectives[level].word)) return true;
    Expression joined;
    joined.kind = kConnectives[level].kind;
    joined.operands.push_back(std::move(result));
    while (in_.take(kConnectives[level].word)) {
        Expression operand;
        if (!parse_operators(operand, level + 1)) return false;
        joined.operands.push_back(std::move(operand));
    }
    joined.span = in_.span_since(first);
    result = std::move(joined);
    return true;
}

bool ExpressionParser::parse_primary(Expression& result) {
    const bool before_operand =
        in_.is_word_at(1) || (in_.token(1).kind == TokenKind::symbol && in_.token(1).text == "(");
    mend_foreign_word(in_, false);
    if (before_operand) in_.mend({"NOT"}, "a condition");
    if (!in_property_ && refuse_misplaced_time(in_, values_) && in_.at("THEN")) {
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
        const bool sound = in_.nested([&] { return parse(result); });
        if (sound && !in_property_) refuse_misplaced_time(in_, values_);
        return sound && in_.expect_symbol(")", "to close the parenthesis");
    }
    const bool sound = (!in_property_ && refuse_foreign_condition(in_, !another_follows_, result)) ||
                       parse_named_primary(result);
    result.span = in_.span_since(first);
    return sound;
}

bool ExpressionParser::parse_named_primary(Expression& result) {
    if (in_.is_symbol_at(1, ".") && !mend_numbered_timer(in_)) in_.mend({"TIMER", "COUNTER"}, "a condition");
    if (in_property_ && in_.at("STEP")) return parse_step_test(result);
    if (!in_property_ && at_edge(in_)) return parse_edge(result);
    if (refuse_call_or_part(in_, in_property_, !another_follows_) ||
        refuse_time_as_condition(in_, values_, in_property_, result))
        return true;
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

/// R_TRIG(Start)
bool ExpressionParser::parse_edge(Expression& result) {
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

/// STEP = Name, or its number; STEP IN Group.
bool ExpressionParser::parse_step_test(ast::Expression& result) {
    in_.skip();
    result.kind = ast::Expression::Kind::step;
    if (in_.take("IN")) {
        result.value = true;
        result.name = name_of(in_.token());
        if (in_.at_symbol("(")) {
            in_.report().add("E010", in_.token().span, "STEP IN takes the name of one group",
                             "give the steps one: GROUP Name: steps; and write STEP IN Name");
            return false;
        }
        return notes_.expect_name(result.name, "the name of a group", ast::Role::step_or_group);
    }
    if (in_.at_symbol("<")) {
        in_.report().add("E010", in_.token().span, "a step is compared with = alone",
                         "write NOT STEP = Name");
        return false;
    }
    if (!in_.expect_symbol("=", "or IN behind STEP, as in STEP = Idle")) return false;
    const Token target = in_.token();
    if (in_.at_symbol("=")) {
        in_.report().add("E010", target.span, "= stands twice", "write it once, as in STEP = Idle");
        in_.skip();
        return parse_step_name(result);
    }
    return parse_step_name(result);
}

bool ExpressionParser::parse_step_name(ast::Expression& result) {
    result.name = name_of(in_.token());
    if (in_.take("POWER_UP")) return true;
    if (in_.token().kind != TokenKind::number)
        return notes_.expect_name(result.name, "the name of a step, or its number", ast::Role::step);
    in_.skip();
    return true;
}

}  // namespace nplc::seqc
