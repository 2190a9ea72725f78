#include "syntax/parser.h"

namespace nplc::seqc {

void Parser::parse_property(ast::Program& program) {
    const Token first = token();
    ++at_;
    ast::Name name;
    if (!expect_name(name, "the property's name") || !expect_symbol(":", "behind the property's name"))
        return recover();
    in_property_ = true;
    const bool sound = parse_claim();
    in_property_ = false;
    if (!sound) return recover();
    Span span = span_since(first);
    if (at_symbol(";")) span.length = token().span.offset + token().span.length - span.offset;
    program.properties.push_back(span);
    end_statement();
}

bool Parser::parse_claim() {
    ast::Expression condition;
    ast::Value time;
    if (take("NEVER")) return parse_expression(condition);
    if (take("ALWAYS")) {
        take("POSSIBLE");
        return parse_expression(condition);
    }
    if (take("WHENEVER")) {
        return parse_expression(condition) && expect("THEN", "behind WHENEVER's condition") &&
               parse_expression(condition) && expect("WITHIN", "behind THEN's condition") &&
               parse_value(time);
    }
    return parse_expression(condition) && expect("IS", "behind a condition that begins a property") &&
           expect("REACHABLE", "behind IS");
}

/// STEP = Name, or its number. What it means is `tools/verify`'s.
bool Parser::parse_step_test() {
    ++at_;
    ast::Name name;
    ast::Value number;
    if (!expect_symbol("=", "behind STEP, as in STEP = Idle")) return false;
    if (take("POWER_UP")) return true;
    return token().kind == TokenKind::identifier ? expect_name(name, "the name of a step")
                                                 : parse_value(number);
}

}  // namespace nplc::seqc
