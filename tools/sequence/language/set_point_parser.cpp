#include "language/set_point_parser.h"

#include <utility>

#include "language/reserved_words.h"

namespace nplc::seqc {
namespace {

/// The declaration's semicolon stands further on in this line.
bool goes_on_in_line(const TokenStream& in) {
    const Token& last = in.last();
    const std::string_view rest = in.source().substr(last.span.offset + last.span.length);
    const std::string_view line = rest.substr(0, rest.find('\n'));
    for (std::size_t ahead = 0; in.token(ahead).kind != TokenKind::end; ++ahead) {
        if (in.token(ahead).span.offset >= last.span.offset + last.span.length + line.size()) return false;
        if (in.is_symbol_at(ahead, ";")) return ahead > 0;
    }
    return false;
}

/// Behind what is wrong in it. The word STEP may follow, which begins a step elsewhere.
void leave_set_point(TokenStream& in) {
    if (!goes_on_in_line(in)) return in.recover();
    while (!in.take_symbol(";")) in.skip();
}

}  // namespace

void SetPointParser::parse(ast::Program& program) {
    in_.skip();
    ast::SetPoint point;
    if (!notes_.expect_name(point.name, "the set-point's name", ast::Role::set_point, true)) {
        notes_.miss_names();
        return in_.recover();
    }
    notes_.begin_declaration(point.name.text);
    if (!parse_place(point) || !parse_range(point)) return leave_set_point(in_);
    if (goes_on_in_line(in_)) {
        in_.error_here("';' or STEP behind the range", "every statement ends with a semicolon");
        return leave_set_point(in_);
    }
    notes_.end_declaration();
    program.set_points.push_back(std::move(point));
    in_.end_statement();
}

/// AT register := value
bool SetPointParser::parse_place(ast::SetPoint& point) {
    if (in_.take("AT")) {
        in_.note_place(ast::Role::register_name);
        if (in_.take("REG")) {
            if (!values_.parse_register_number(point.register_number)) return false;
        } else if (in_.token().kind == TokenKind::identifier && !is_reserved(in_.token().text)) {
            point.address = name_of(in_.token());
            notes_.add_use(ast::Role::register_name, in_.token().span);
            in_.skip();
        } else {
            in_.error_here(
                "a register, such as P1 or V_SOLL",
                "a time or a count has no place: leave AT out, and write TIMER := Name; in a branch");
            return false;
        }
    }
    return in_.expect_symbol(":=",
                             "and the value that it begins with, as in SET_POINT Length AT P1 := 80 mm RANGE "
                             "10 .. 200 mm;") &&
           parse_bound(point.value);
}

/// RANGE low .. high [STEP step]
bool SetPointParser::parse_range(ast::SetPoint& point) {
    if (!in_.expect("RANGE", "behind the value, as in RANGE 10 .. 200 mm") || !parse_bound(point.low))
        return false;
    if (in_.at_symbol(";") && point.low.kind == ast::Value::Kind::sum) {
        in_.error_here("'..' between the ends of the range",
                       "10 - 200 is a difference: write RANGE 10 .. 200 mm");
        return false;
    }
    if (!in_.expect_symbol("..", "between the ends of the range, as in RANGE 10 .. 200 mm") ||
        !parse_bound(point.high)) {
        return false;
    }
    if (in_.take("STEP")) {
        point.step.emplace();
        if (!parse_bound(*point.step)) return false;
    }
    return true;
}

/// A number that the lexer has refused is followed by no conclusion from it.
bool SetPointParser::parse_bound(ast::Value& value) {
    const Token first = in_.token();
    return values_.parse(value) &&
           (first.kind != TokenKind::number || first.text.size() == first.span.length);
}

}  // namespace nplc::seqc
