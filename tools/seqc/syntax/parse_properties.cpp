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
    add_claim(first, program);
}

bool Parser::parse_claim() {
    ast::Expression condition;
    ast::Value time;
    if (take("NEVER")) {
        if (!parse_expression(condition)) return false;
        return !take("WHILE") || (parse_expression(condition) && expect("FOR", "behind WHILE's condition") &&
                                  parse_value(time));
    }
    if (take("ALWAYS")) {
        take("POSSIBLE");
        return parse_expression(condition);
    }
    if (take("WHENEVER")) return parse_whenever();
    if (take("BETWEEN")) {
        return parse_primary(condition) && expect("AND", "behind BETWEEN's first condition") &&
               parse_primary(condition) && parse_expression(condition) &&
               expect("STAYS", "behind what is to stay") &&
               (take("OFF") || expect("ON", "or OFF behind STAYS"));
    }
    if (take("AFTER")) {
        return parse_expression(condition) && expect("ALWAYS", "behind AFTER's condition") &&
               expect("POSSIBLE", "behind ALWAYS") && parse_expression(condition);
    }
    if (take("EVERY_SCAN")) {
        return expect("FROM", "behind EVERY_SCAN") && parse_expression(condition) &&
               expect("ENDS", "behind FROM's condition") && expect("IN", "behind ENDS") &&
               parse_expression(condition);
    }
    if (!parse_expression(condition)) return false;
    if (take("ONLY")) return expect("AFTER", "behind ONLY") && parse_expression(condition);
    if (take("CHANGES")) {
        return expect("ONLY", "behind CHANGES") && expect("IN", "behind ONLY") && parse_expression(condition);
    }
    return expect("IS", "behind a condition that begins a property") && expect("REACHABLE", "behind IS");
}

bool Parser::parse_whenever() {
    ast::Expression condition;
    ast::Value time;
    if (!parse_expression(condition)) return false;
    if (take("FOLLOWED")) {
        return expect("BY", "behind FOLLOWED") && parse_expression(condition) &&
               expect("THEN", "behind BY's condition") && parse_expression(condition);
    }
    const bool lasts = take("FOR");
    if ((lasts && !parse_value(time)) || !expect("THEN", "behind WHENEVER's condition") ||
        !parse_expression(condition))
        return false;
    return lasts || !take("WITHIN") || parse_value(time);
}

/// What is taken for granted when properties are proved.
void Parser::parse_assumption(ast::Program& program) {
    const Token first = token();
    ++at_;
    ast::Expression condition;
    ast::Value time;
    in_property_ = true;
    const bool sound = take("NEVER")
                           ? parse_expression(condition)
                           : parse_primary(condition) && expect("STABLE", "behind ASSUME's input") &&
                                 expect("FOR", "behind STABLE") && parse_value(time);
    in_property_ = false;
    if (!sound) return recover();
    add_claim(first, program);
}

void Parser::add_claim(const Token& first, ast::Program& program) {
    Span span = span_since(first);
    if (at_symbol(";")) span.length = token().span.offset + token().span.length - span.offset;
    program.properties.push_back(span);
    end_statement();
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
