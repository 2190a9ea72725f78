#include "language/parser.h"

namespace nplc::seqc {

void Parser::parse_set_point(ast::Program& program) {
    ++at_;
    ast::SetPoint point;
    if (!expect_name(point.name, "the set-point's name", ast::Role::set_point, true)) {
        names_missing_ = true;
        return recover();
    }
    faulty_names_.push_back(point.name.text);
    if (!parse_set_point_place(point) || !parse_range(point)) return leave_set_point();
    if (goes_on_in_line()) {
        error_here("';' or STEP behind the range", "every statement ends with a semicolon");
        return leave_set_point();
    }
    faulty_names_.pop_back();
    program.set_points.push_back(std::move(point));
    end_statement();
}

/// Behind what is wrong in it. The word STEP may follow, which begins a step elsewhere.
void Parser::leave_set_point() {
    if (!goes_on_in_line()) return recover();
    while (!take_symbol(";")) ++at_;
}

/// The declaration's semicolon stands further on in this line.
bool Parser::goes_on_in_line() const {
    const Token& last = tokens_[at_ - 1];
    const std::string_view rest = source_.substr(last.span.offset + last.span.length);
    const std::string_view line = rest.substr(0, rest.find('\n'));
    for (std::size_t ahead = 0; token(ahead).kind != TokenKind::end; ++ahead) {
        if (token(ahead).span.offset >= last.span.offset + last.span.length + line.size()) return false;
        if (is_symbol_at(ahead, ";")) return ahead > 0;
    }
    return false;
}

/// A number that the lexer has refused is followed by no conclusion from it.
bool Parser::parse_bound(ast::Value& value) {
    const Token first = token();
    return parse_value(value) && (first.kind != TokenKind::number || first.text.size() == first.span.length);
}

/// AT register := value
bool Parser::parse_set_point_place(ast::SetPoint& point) {
    if (take("AT")) {
        note_place(ast::Role::register_name);
        if (take("REG")) {
            if (!parse_register_number(point.register_number)) return false;
        } else if (token().kind == TokenKind::identifier && !is_reserved(token().text)) {
            point.address = name_of(token());
            note_use(ast::Role::register_name, token().span);
            ++at_;
        } else {
            error_here("a register, such as P1 or V_SOLL",
                       "a time or a count has no place: leave AT out, and write TIMER := Name; in a branch");
            return false;
        }
    }
    return expect_symbol(":=",
                         "and the value that it begins with, as in SET_POINT Length AT P1 := 80 mm RANGE "
                         "10 .. 200 mm;") &&
           parse_bound(point.value);
}

/// RANGE low .. high [STEP step]
bool Parser::parse_range(ast::SetPoint& point) {
    if (!expect("RANGE", "behind the value, as in RANGE 10 .. 200 mm") || !parse_bound(point.low))
        return false;
    if (at_symbol(";") && point.low.kind == ast::Value::Kind::sum) {
        error_here("'..' between the ends of the range",
                   "10 - 200 is a difference: write RANGE 10 .. 200 mm");
        return false;
    }
    if (!expect_symbol("..", "between the ends of the range, as in RANGE 10 .. 200 mm") ||
        !parse_bound(point.high)) {
        return false;
    }
    if (take("STEP")) {
        point.step.emplace();
        if (!parse_bound(*point.step)) return false;
    }
    return true;
}

void Parser::parse_takes(ast::Step& step) {
    step.takes_set_points_span = token().span;
    ++at_;
    if (!expect("SET_POINTS", "after TAKES")) return recover();
    step.takes_set_points_span = span_since(tokens_[at_ - 2]);
    step.takes_set_points = true;
    end_statement();
}

}  // namespace nplc::seqc
